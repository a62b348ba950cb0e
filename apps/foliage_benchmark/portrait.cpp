#include "apps/foliage_benchmark/portrait.h"

#include <cstring>

namespace manzana::foliage_benchmark {

Portrait::Portrait(const foliage::PreparedPlant& plant, double height_px)
    : stage_({&plant, 1}, sites_of({&plant, 1})), shot_(shot_of(extent_of(plant), 0.4, 0.15, height_px)) {}

void Portrait::use(const Detail& detail) {
  stage_.set_details(same_everywhere(stage_.plants(), [&](const PreparedPlant&) { return detail; }));
}

Picture Portrait::draw(const Detail& way, Sampling sampling) {
  use(way);
  return stage_.draw(run(), shot_, {1, sampling});
}

void Portrait::look(const Detail& way, const Detail& reference, TimeRow& row) {
  if (!expected_ || std::memcmp(&expected_->detail, &reference, sizeof reference) != 0) {
    Picture picture = draw(reference, Sampling::fine);
    expected_ = {reference, std::move(picture), primitives_of(stage_.shown())};
  }
  row.reference_primitives = expected_->primitives;
  const Picture seen = draw(way, Sampling::fine);
  row.primitives = primitives_of(stage_.shown());
  set_errors(image_error(expected_->picture, seen), row);
}

void Portrait::time(const Detail& way, const Detail& reference, double seconds, TimeRow& row) {
  const auto draw = [&](const Detail& detail) {
    use(detail);
    stage_.draw_only({{run()}}, shot_, {1, Sampling::product});
  };
  set_times(time_pairs([&] { draw(way); }, [&] { draw(reference); }, seconds, 1), row);
}

}  // namespace manzana::foliage_benchmark
