// Every measure of error of real pictures, against scikit-image and SciPy. Skipped where these are not installed.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>

#include "apps/foliage_benchmark/errors.h"
#include "foliage/generate.h"
#include "foliage/import/species.h"
#include "foliage/prepare.h"
#include "gl/context.h"
#include "tests/support/temporary_folder.h"

namespace manzana::foliage_benchmark {
namespace {

void write(const std::filesystem::path& file, const Picture& picture) {
  std::ofstream(file, std::ios::binary)
      .write(reinterpret_cast<const char*>(picture.texels.data()),
             static_cast<std::streamsize>(picture.texels.size() * sizeof(Vec4)));
}

/// Plants near and far, by several laws, against all detail.
void write_pairs(const std::filesystem::path& folder) {
  std::ofstream list(folder / "pairs.csv");
  list.precision(12);
  list << "a,b,width,height,cover,iou,silhouette,colour,ssim,gmsd,psnr\n";
  int n = 0;
  for (const char* species : {"oak", "birch"}) {
    const std::vector plants{prepare(grow_plant(foliage::builtin_species(species), 1), {.visibility_side = 0})};
    Stage stage(plants, sites_of(plants));
    for (const double height_px : {16.0, 48.0, 131.0}) {
      const Shot shot = shot_of(extent_of(plants[0]), 0.4 * n, 0.1, height_px);
      const auto draw = [&](foliage::Law law, double error_px) {
        stage.set_law(law);
        return stage.draw({0, 1}, shot, {error_px, Sampling::product});
      };
      const Picture full = draw(foliage::Law::full, 1);
      for (const double error_px : {1.0, 4.0}) {
        const Picture ours = draw(foliage::Law::ours, error_px);
        const std::string a = std::to_string(n) + "a", b = std::to_string(n) + "b";
        write(folder / a, full), write(folder / b, ours);
        const ImageError e = image_error(full, ours);
        list << a << ',' << b << ',' << full.width << ',' << full.height << ',' << e.cover << ',' << e.iou << ','
             << e.silhouette << ',' << e.colour << ',' << e.ssim << ',' << e.gmsd << ',' << e.psnr << '\n';
        ++n;
      }
    }
  }
}

}  // namespace

TEST_CASE("image error: twelve pairs of plants as another implementation sees them") {
  if (std::system("/usr/bin/python3 -c 'import skimage' 2> /dev/null") != 0) {
    WARN("scikit-image is not installed: skipped");
    return;
  }
  const gl::HeadlessContext context;
  const TemporaryFolder scratch;
  write_pairs(scratch.path());
  CHECK(std::system(("/usr/bin/python3 " MANZANA_METRICS_CHECK " '" + scratch.path().string() + "'").c_str()) == 0);
}

}  // namespace manzana::foliage_benchmark
