#include "apps/walkthrough/overlay.h"

#include <imgui.h>

#include <array>
#include <cmath>

#include "scenegraph/draw/frame_data.h"

namespace manzana::walkthrough {
namespace {

struct KeyHelp {
  const char *keys, *what;
};
constexpr std::array<KeyHelp, 15> kKeys{{
    {"W A S D", "move (arrow keys too)"},
    {"mouse", "look about"},
    {"Shift", "faster"},
    {"F or Tab", "fly, or walk again"},
    {"E Q, Space C", "up, down (flying)"},
    {"wheel", "speed (flying)"},
    {"G", "follow the nearest car, or get out"},
    {"P", "play the camera path, or leave it"},
    {"F1", "these keys"},
    {"F2", "panel: times, counts, layers"},
    {"F3", "freeze what is culled, and look at it from outside"},
    {"F5", "structure: BqR-Tree or none"},
    {"F6", "record a camera path, stop recording"},
    {"F12", "screenshot"},
    {"Esc", "free the mouse (click: catch it); again: quit"},
}};

constexpr ImGuiWindowFlags kStill = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoFocusOnAppearing |
                                    ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoInputs;

/// A text without a frame of its own, its corner `pivot` at that place of the window.
void draw_note(const char* id, const std::string& text, const ImVec2& place, const ImVec2& pivot) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x * place.x, size.y * place.y}, ImGuiCond_Always, pivot);
  ImGui::SetNextWindowBgAlpha(0.5F);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
  if (ImGui::Begin(id, nullptr, kStill)) ImGui::TextUnformatted(text.c_str());
  ImGui::End();
  ImGui::PopStyleVar();
}

void draw_times(const PanelState& panel, const Stage& stage) {
  const FrameRow& s = panel.smooth;
  ImGui::Text("frame   %7.1f ms (%.0f a second)", panel.frame_ms, 1000 / std::max(panel.frame_ms, 0.01));
  ImGui::Text("cull    %7.1f us", s.cull_us);
  ImGui::Text("update  %7.1f us", s.update_us);
  ImGui::Text("draw    %7.1f ms", s.draw_ms);
  ImGui::Separator();
  ImGui::Text("blocks    %8llu of %zu", static_cast<unsigned long long>(s.blocks_visible), stage.scene.blocks.size());
  ImGui::Text("buildings %8llu of %u", static_cast<unsigned long long>(s.buildings_visible),
              stage.scene.buildings.table.size());
  ImGui::Text("trees     %8llu of %u", static_cast<unsigned long long>(s.trees_visible),
              stage.scene.trees.table.size());
  ImGui::Text("cars      %8llu of %u", static_cast<unsigned long long>(s.cars_visible), stage.scene.traffic.cars());
  ImGui::Text("triangles %8llu", static_cast<unsigned long long>(s.triangles));
  ImGui::Text("points    %8llu", static_cast<unsigned long long>(s.points));
  ImGui::Text("error in trees %7.2f px (%s)", s.tree_error_px, name_of(s.tree_law));
  if (s.trees_missing > 0) ImGui::Text("%s", kTreesMissing);
  if (s.meshes_missing > 0) ImGui::Text("%s", kMeshesMissing);
}

void draw_tree_detail(Stage& stage) {
  draw::DrawOptions& options = stage.options;
  auto error = static_cast<float>(options.tree_error_px), thousands = static_cast<float>(options.tree_vertices / 1000);
  if (ImGui::SliderFloat("tree error", &error, 0.1F, 32, "%.2f px", ImGuiSliderFlags_Logarithmic))
    options.tree_error_px = static_cast<double>(error);
  auto wind = static_cast<float>(options.wind);
  if (ImGui::SliderFloat("wind", &wind, 0, 1, "%.2f")) options.wind = static_cast<double>(wind);
  if (ImGui::SliderFloat("tree budget", &thousands, 0, 10000, thousands > 0 ? "%.0f k vertices" : "none",
                         ImGuiSliderFlags_Logarithmic))
    options.tree_vertices = std::floor(static_cast<double>(thousands)) * 1000;
  auto ms = static_cast<float>(stage.tree_ms);
  if (ImGui::SliderFloat("frame budget", &ms, 0, 200, ms > 0 ? "%.0f ms" : "none", ImGuiSliderFlags_Logarithmic))
    stage.tree_ms = std::floor(static_cast<double>(ms));
  if (stage.tree_ms > 0) ImGui::Text("so trees have %.0f k vertices", stage.time_budget.vertices / 1000);
}

void draw_layers(draw::Layers& layers) {
  ImGui::Checkbox("buildings", &layers.buildings);
  ImGui::SameLine(130);
  ImGui::Checkbox("ground", &layers.surfaces);
  ImGui::Checkbox("trees", &layers.trees);
  ImGui::SameLine(130);
  ImGui::Checkbox("cars", &layers.cars);
  ImGui::Checkbox("sky", &layers.sky);
  ImGui::SameLine(130);
  ImGui::Checkbox("fog", &layers.fog);
}

void draw_light(PanelState& panel, draw::DrawOptions& options) {
  bool moved = ImGui::SliderFloat("sun from", &panel.sun_azimuth_deg, 0, 360, "%.0f deg");
  moved |= ImGui::SliderFloat("sun height", &panel.sun_elevation_deg, 2, 90, "%.0f deg");
  if (moved)
    options.sun =
        draw::sun_direction(static_cast<double>(panel.sun_azimuth_deg), static_cast<double>(panel.sun_elevation_deg));
  auto fog = static_cast<float>(options.fog_distance_m);
  if (ImGui::SliderFloat("fog at", &fog, 100, 50000, "%.0f m", ImGuiSliderFlags_Logarithmic))
    options.fog_distance_m = static_cast<double>(fog);
}

}  // namespace

void take_in(PanelState& panel, const FrameRow& row, double frame_seconds) {
  const double share = 1 - std::exp(-frame_seconds / 0.5);
  const FrameRow before = panel.smooth;
  panel.smooth = row;
  panel.smooth.cull_us = glm::mix(before.cull_us, row.cull_us, share);
  panel.smooth.update_us = glm::mix(before.update_us, row.update_us, share);
  panel.smooth.draw_ms = glm::mix(before.draw_ms, row.draw_ms, share);
  panel.frame_ms = glm::mix(panel.frame_ms, frame_seconds * 1000, share);
}

void draw_panel(PanelState& panel, Stage& stage, const Camera& camera) {
  ImGui::SetNextWindowPos({10, 10}, ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize({290, 0}, ImGuiCond_FirstUseEver);
  if (ImGui::Begin("Manzana", nullptr, ImGuiWindowFlags_AlwaysAutoResize)) {
    draw_times(panel, stage);
    ImGui::Separator();
    draw_layers(stage.options.layers);
    bool tree = stage.structure == Structure::bqr;
    if (ImGui::Checkbox("BqR-Tree", &tree)) stage.structure = tree ? Structure::bqr : Structure::none;
    ImGui::SameLine(130);
    ImGui::Checkbox("wait for the screen", &panel.vsync);
    draw_tree_detail(stage);
    draw_light(panel, stage.options);
    ImGui::Text("at %.0f, %.0f, %.1f m up; flying %.0f m/s", camera.eye.x, camera.eye.y, camera.eye.z,
                camera.fly_speed);
  }
  ImGui::End();
}

void draw_key_help() {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x / 2, size.y / 2}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowBgAlpha(0.7F);
  if (ImGui::Begin("keys", nullptr, kStill) && ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
    for (const KeyHelp& key : kKeys) {
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(key.keys);
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(key.what);
    }
    ImGui::EndTable();
  }
  ImGui::End();
}

void draw_attribution(const std::string& text) {
  if (!text.empty()) draw_note("attribution", text, {1, 1}, {1, 1});
}

void draw_message(const std::string& text) {
  if (!text.empty()) draw_note("message", text, {0.5F, 0.97F}, {0.5F, 1});
}

}  // namespace manzana::walkthrough
