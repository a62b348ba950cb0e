#include "apps/walkthrough/summary.h"

#include <sys/resource.h>

#include <nlohmann/json.hpp>

#include "apps/common/quantile.h"

namespace manzana::walkthrough {
namespace {

using Json = nlohmann::ordered_json;

Json medians(std::span<const FrameRow> rows) {
  const auto median = [&](auto get) { return apps::quantile(column(rows, get), 0.5); };
  return {{"cull_us", median(&FrameRow::cull_us)},
          {"update_us", median(&FrameRow::update_us)},
          {"draw_ms", median(&FrameRow::draw_ms)},
          {"blocks_visible", median(&FrameRow::blocks_visible)},
          {"buildings_visible", median(&FrameRow::buildings_visible)},
          {"trees_visible", median(&FrameRow::trees_visible)},
          {"cars_visible", median(&FrameRow::cars_visible)},
          {"triangles", median(&FrameRow::triangles)},
          {"points", median(&FrameRow::points)},
          {"frame_ms", median(&FrameRow::frame_ms)}};
}

Json tails(std::span<const FrameRow> rows) {
  return {{"draw_ms", apps::quantile(column(rows, &FrameRow::draw_ms), 0.99)},
          {"frame_ms", apps::quantile(column(rows, &FrameRow::frame_ms), 0.99)}};
}

}  // namespace

std::string summary_json(const Options& options, const Imported& city, std::span<const FrameRow> rows,
                         const RunFacts& facts) {
  const Scene& scene = city.scene;
  Json json{{"city", options.city},
            {"structure", name_of(options.structure)},
            {"path", facts.path},
            {"frames", rows.size()},
            {"size", {options.size.width, options.size.height}},
            {"quality", facts.quality},
            {"seed", options.seed},
            {"blocks", city.report.blocks},
            {"fallback_blocks", city.report.fallback_blocks},
            {"objects", city.report.objects},
            {"objects_per_block", {{"median", city.report.objects_median}, {"largest", city.report.objects_largest}}},
            {"buildings", scene.buildings.table.size()},
            {"trees", scene.trees.table.size()},
            {"cars", scene.traffic.cars()},
            {"import_s", city.report.seconds},
            {"issues", city.issues.size()},
            {"median", medians(rows)},
            {"p99", tails(rows)},
            {"memory_mb", facts.memory_mb},
            {"renderer", facts.renderer},
            {"attribution", scene.attribution}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";  // file names need not be UTF-8
}

double largest_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

}  // namespace manzana::walkthrough
