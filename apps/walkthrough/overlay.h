#pragma once
/// What Dear ImGui draws over the picture: the panel, the keys, messages, the attribution.
#include <string>

#include "apps/walkthrough/camera_controller.h"
#include "apps/walkthrough/frame.h"

namespace manzana::walkthrough {

/// What the panel can change beside the stage.
struct PanelState {
  bool vsync = true;
  float sun_azimuth_deg = 141, sun_elevation_deg = 45;  ///< from north to the right; above the horizon
  FrameRow smooth;                                      ///< times, averaged over about half a second
  double frame_ms = 0;                                  ///< from picture to picture, the same
};

/// Mixes a frame's times into the averages, and takes over its counts.
void take_in(PanelState& panel, const FrameRow& row, double frame_seconds);

/// Times, counts, and a switch for each layer.
void draw_panel(PanelState& panel, Stage& stage, const Camera& camera);
void draw_key_help();
void draw_attribution(const std::string& text);  ///< lower right corner; nothing for an empty text
void draw_message(const std::string& text);      ///< at the lower edge

}  // namespace manzana::walkthrough
