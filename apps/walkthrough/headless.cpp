#include "apps/walkthrough/headless.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <stdexcept>

#include "apps/common/progress_bar.h"
#include "apps/common/quantile.h"
#include "apps/walkthrough/caption.h"
#include "apps/walkthrough/endurance.h"
#include "apps/walkthrough/frame.h"
#include "apps/walkthrough/load.h"
#include "apps/walkthrough/memory_report.h"
#include "apps/walkthrough/summary.h"
#include "files/whole_file.h"
#include "gl/context.h"

namespace manzana::walkthrough {
namespace {

std::string frame_name(int frame) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "frame_%04d.png", frame);
  return name.data();
}

void write_frame(Stage& stage, const std::filesystem::path& file) {
  Picture picture{stage.size, stage.renderer.read_pixels()};
  draw_caption(picture, stage.scene.attribution);
  write_png(file, picture);
}

/// Frames that the path takes once: all, or of --hours at most a quarter.
int frames_a_lap(const Options& options) {
  constexpr int kMost = 240;
  return options.hours > 0 ? std::clamp(options.frames / 4, 1, kMost) : options.frames;
}

double seconds_at(const Options& options, int frame) {
  return options.hours > 0 ? options.hours * 3600 * (frame + 1.0) / options.frames : frame / kFramesPerSecond;
}

/// Streams are as large as the fullest frame so far, and that depends on where the cars are.
std::size_t bytes_that_stay(const draw::DeviceMemory& memory) { return memory.sum() - memory.stream; }

std::vector<FrameRow> draw_path(const Options& options, Stage& stage, const CameraPath& path, PathNeeds& needs,
                                Endurance& day) {
  const int lap = frames_a_lap(options);
  const auto view_at = [&](int frame) {
    return view_of(stage.scene.frame, pose_at(path, path_time(path, frame % lap, lap)), stage.aspect());
  };
  apps::ProgressBar bar(stderr);
  std::vector<FrameRow> rows;
  rows.reserve(static_cast<std::size_t>(options.frames));
  draw_frame(stage, view_at(0), 0);
  for (int frame = 0; frame < options.frames; ++frame) {
    rows.push_back(draw_frame(stage, view_at(frame), seconds_at(options, frame)));
    if (options.hours > 0)
      day.see(stage.scene, seconds_at(options, frame), bytes_that_stay(stage.renderer.memory()), frame / lap);
    if (options.report_memory) needs.see(stage.sets);
    if (frame % options.every == 0) write_frame(stage, options.out / frame_name(frame));
    bar.show("drawing", (frame + 1.0) / options.frames);
  }
  return rows;
}

void warn(foliage::Law asked, std::span<const FrameRow> rows) {
  const auto other_law = [&](const FrameRow& row) { return row.trees_visible > 0 && row.tree_law != asked; };
  if (const auto n = std::count_if(rows.begin(), rows.end(), other_law); n > 0)
    std::fprintf(stderr, "no room for what %s shows of trees: in %td of %zu frames %s shows less\n", name_of(asked), n,
                 rows.size(), name_of(foliage::Law::ours));
  const auto missing = [](const FrameRow& row) { return row.trees_missing > 0; };
  if (std::any_of(rows.begin(), rows.end(), missing)) std::fprintf(stderr, "%s\n", kTreesMissing);
  const auto hidden = [](const FrameRow& row) { return row.meshes_missing > 0; };
  if (std::any_of(rows.begin(), rows.end(), hidden)) std::fprintf(stderr, "%s\n", kMeshesMissing);
}

void print_result(const Options& options, std::span<const FrameRow> rows) {
  const auto median = [&](auto get) { return apps::quantile(column(rows, get), 0.5); };
  std::printf("%zu frames, medians: cull %.1f us, cars %.1f us, draw %.1f ms, %.0f triangles\n", rows.size(),
              median(&FrameRow::cull_us), median(&FrameRow::update_us), median(&FrameRow::draw_ms),
              median(&FrameRow::triangles));
  std::printf("written to %s\n", options.out.c_str());
}

}  // namespace

void run_headless(const Options& options, const Imported& city, std::span<const foliage::PreparedPlant> plants,
                  const CameraPath& path) {
  const gl::HeadlessContext context;
  const std::string renderer = gl::renderer_name();
  const auto quality = options.quality.empty() ? draw::quality_for(renderer) : draw::quality_named(options.quality);
  Stage stage(city.scene, plants, quality, options.size, gpu_bytes(options));
  PathNeeds needs(city.scene);
  Endurance day;
  apply(options, stage);
  stage.whole = true;
  if (options.packs) make_far_trees(stage, plants);
  const std::vector<FrameRow> rows = draw_path(options, stage, path, needs, day);
  const RunFacts facts{renderer, quality.name, path.name, largest_memory_mb()};
  files::write_whole(options.out / "frames.csv", to_csv(rows));
  files::write_whole(options.out / "issues.txt", issue_table(city.issues));
  files::write_whole(options.out / "summary.json", summary_json(options, city, rows, facts));
  warn(*stage.options.tree_law, rows);
  print_result(options, rows);
  if (options.hours > 0) std::printf("%s", to_text(day).c_str());
  if (const auto what = drift(day)) throw std::runtime_error("not the same over the day: " + *what);
  if (options.report_memory)
    std::printf("%s", to_text(report_memory(city.scene, plants, needs, stage.renderer.memory())).c_str());
}

}  // namespace manzana::walkthrough
