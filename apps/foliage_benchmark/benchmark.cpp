#include "apps/foliage_benchmark/benchmark.h"

#include <cstdio>

#include "apps/common/png.h"
#include "apps/common/progress_bar.h"
#include "apps/foliage_benchmark/errors.h"
#include "files/whole_file.h"
#include "foliage/import/load_plant.h"
#include "foliage/import/species.h"
#include "gl/context.h"

namespace manzana::foliage_benchmark {
namespace {

std::vector<foliage::PreparedPlant> plants_of(const Options& options) {
  std::vector<foliage::PreparedPlant> plants;
  apps::ProgressBar bar(stderr);
  const auto tell = [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); };
  const auto preparing = [&](const std::string& name) {
    foliage::PrepareOptions how;
    how.progress = [&bar, name](double done) { bar.show("preparing " + name, done); };
    return how;
  };
  for (const std::string& text : options.plants) {
    const foliage::PlantSource source = foliage::parse_plant_source(text);
    plants.push_back(load_or_prepare(source, foliage::default_cache_folder(), preparing(text), tell));
    plants.back().name = source.file.stem().string();
  }
  if (!options.plants.empty()) return plants;
  for (const std::string_view name : foliage::kSpeciesNames) {
    if (options.quick && plants.size() == 2) break;
    plants.push_back(prepare(grow_plant(foliage::builtin_species(name), 1), preparing(std::string(name))));
    plants.back().name = name;
  }
  return plants;
}

ErrorPlan plan_of(const Options& options) {
  ErrorPlan plan;
  plan.error_px = options.error_px;
  if (options.quick) {
    plan.heights = {128, 32, 12};
    plan.views = 2;
  }
  if (!options.heights.empty()) plan.heights = options.heights;
  if (options.views) plan.views = *options.views;
  return plan;
}

void write_sheet(const std::filesystem::path& file, const Picture& sheet) {
  apps::write_png(file, sheet.width, sheet.height, to_rgb8(sheet));
}

}  // namespace

int run_benchmark(const Options& options) {
  files::make_folder(options.out);
  const gl::HeadlessContext context;
  const auto plants = plants_of(options);
  const ErrorPlan plan = plan_of(options);
  std::vector<ErrorRow> rows;
  {
    apps::ProgressBar bar(stderr);
    rows = measure_errors(plants, plan, [&](double done) { bar.show("image errors", done); });
  }
  std::string text;
  for (const Verdict& v : judge(rows)) {
    char line[400];
    const ErrorRow& m = v.mean;
    std::snprintf(line, sizeof line,
                  "%-24s %4.0f px %-6s %-7s prims %7llu (bark %llu leaves %llu lines %llu points %llu)  cover %.3f%s "
                  "colour %.4f%s ssim %.3f/%.3f%s gmsd %.3f/%.3f%s iou %.3f sil %.3f psnr %.1f %s\n",
                  m.plant.c_str(), m.height_px, m.law.c_str(), m.sampling.c_str(),
                  static_cast<unsigned long long>(m.primitives), static_cast<unsigned long long>(m.bark),
                  static_cast<unsigned long long>(m.leaves), static_cast<unsigned long long>(m.lines),
                  static_cast<unsigned long long>(m.points), m.cover, v.cover ? "" : "!", m.colour,
                  v.colour ? "" : "!", m.ssim, v.floor_ssim, v.ssim ? "" : "!", m.gmsd, v.floor_gmsd,
                  v.gmsd ? "" : "!", m.iou, m.silhouette, m.psnr, v.all() ? "pass" : "FAIL");
    text += line;
  }
  files::write_whole(options.out / "errors.txt", text);
  Stage stage(plants, sites_of(plants));
  constexpr std::array kSheetHeights{256.0, 128.0, 64.0, 32.0, 16.0};
  for (std::uint32_t i = 0; i < plants.size(); ++i)
    write_sheet(options.out / ("sheet_" + plants[i].name + ".png"),
                contact_sheet(stage, i, extent_of(plants[i]), foliage::Law::ours, plan.error_px, kSheetHeights));
  std::printf("written to %s\n", options.out.c_str());
  return 0;
}

}  // namespace manzana::foliage_benchmark
