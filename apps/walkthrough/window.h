#pragma once
/// The walkthrough in a window: see key_help() in overlay.cpp for what keys do.
#include <span>

#include "apps/walkthrough/camera_path.h"
#include "apps/walkthrough/options.h"
#include "foliage/prepared_plant.h"
#include "scenegraph/import/import.h"

namespace manzana::walkthrough {

/// The windowing system, while this lives. Not open when it is unwanted or there is none: that is no error.
class Display {
 public:
  explicit Display(bool unwanted);
  ~Display();
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;
  bool open() const { return open_; }

 private:
  bool open_ = false;
};

/// Needs an open display. Returns when the window is closed. Throws std::runtime_error when there is no GL 4.5.
void run_window(const Options& options, const Imported& city, std::span<const foliage::PreparedPlant> plants,
                const CameraPath& path);

}  // namespace manzana::walkthrough
