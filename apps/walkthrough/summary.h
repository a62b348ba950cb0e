#pragma once
/// summary.json: what was drawn, on what, and what it cost.
#include <span>
#include <string>

#include "apps/walkthrough/frame_log.h"
#include "apps/walkthrough/options.h"
#include "scenegraph/import/import.h"

namespace manzana::walkthrough {

/// What is known beside the city and the frames.
struct RunFacts {
  std::string renderer;  ///< GL_RENDERER
  std::string quality;   ///< low or high, as it was used
  std::string path;      ///< name of the camera path
  double memory_mb = 0;  ///< largest resident set of the process so far, MiB
};

std::string summary_json(const Options& options, const Imported& city, std::span<const FrameRow> rows,
                         const RunFacts& facts);

double largest_memory_mb();  ///< largest resident set of this process so far, MiB

}  // namespace manzana::walkthrough
