#include "apps/foliage_benchmark/portrait.h"

namespace manzana::foliage_benchmark {

std::uint64_t primitives_of(const foliage::Shown& shown) {
  return 2 * (shown.bark + shown.leaves + shown.lines) + shown.points;
}

Portrait::Portrait(std::span<const foliage::PreparedPlant> plant, double height_px)
    : stage_(plant.first(1), sites_of(plant.first(1))),
      shot_(shot_of(extent_of(plant.front()), 0.4, 0.15, height_px)) {}

void Portrait::use(const Detail& detail) {
  stage_.set_details(same_everywhere(stage_.plants(), [&](const PreparedPlant&) { return detail; }));
}

void Portrait::look(const Detail& way, const Detail& reference, TimeRow& row) {
  use(reference);
  const Picture expected = stage_.draw(run(), shot_, {});
  row.reference_primitives = primitives_of(stage_.shown());
  use(way);
  const Picture seen = stage_.draw(run(), shot_, {});
  row.primitives = primitives_of(stage_.shown());
  const ImageError error = image_error(expected, seen);
  row.cover = error.cover;
  row.ssim = error.ssim;
  row.gmsd = error.gmsd;
}

void Portrait::time(const Detail& way, const Detail& reference, double seconds, TimeRow& row) {
  const auto draw = [&](const Detail& detail) {
    use(detail);
    stage_.draw_only({{run()}}, shot_, {1, Sampling::product});
  };
  set_times(time_pairs([&] { draw(way); }, [&] { draw(reference); }, seconds, 1), row);
}

}  // namespace manzana::foliage_benchmark
