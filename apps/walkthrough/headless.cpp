#include "apps/walkthrough/headless.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "apps/common/progress_bar.h"
#include "apps/common/quantile.h"
#include "apps/walkthrough/caption.h"
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

std::vector<FrameRow> draw_path(const Options& options, Stage& stage, const CameraPath& path, PathNeeds& needs) {
  const auto view_at = [&](int frame) {
    return view_of(stage.scene.frame, pose_at(path, path_time(path, frame, options.frames)), stage.aspect());
  };
  apps::ProgressBar bar(stderr);
  std::vector<FrameRow> rows;
  draw_frame(stage, view_at(0), 0);
  for (int frame = 0; frame < options.frames; ++frame) {
    rows.push_back(draw_frame(stage, view_at(frame), frame / kFramesPerSecond));
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
  apply(options, stage);
  stage.whole = true;
  if (options.packs) make_far_trees(stage, plants);
  const std::vector<FrameRow> rows = draw_path(options, stage, path, needs);
  const RunFacts facts{renderer, quality.name, path.name, largest_memory_mb()};
  files::write_whole(options.out / "frames.csv", to_csv(rows));
  files::write_whole(options.out / "issues.txt", issue_table(city.issues));
  files::write_whole(options.out / "summary.json", summary_json(options, city, rows, facts));
  warn(*stage.options.tree_law, rows);
  print_result(options, rows);
  if (options.report_memory)
    std::printf("%s", to_text(report_memory(city.scene, plants, needs, stage.renderer.memory())).c_str());
}

}  // namespace manzana::walkthrough
