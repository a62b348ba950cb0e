#include "culling/baselines/block_rows.h"

namespace manzana::baselines {

BlockRows rows_of(const City& city, std::span<const std::uint32_t> block_order) {
  BlockRows all;
  all.rows.reserve(city.objects());
  for (const std::uint32_t block : block_order) {
    for (std::uint32_t row = city.first[block]; row < city.first[block + 1]; ++row) all.rows.push_back(row);
    all.first.push_back(static_cast<std::uint32_t>(all.rows.size()));
  }
  return all;
}

std::vector<culling::BoxD> boxes_of(const City& city, std::span<const std::uint32_t> rows) {
  std::vector<culling::BoxD> boxes;
  boxes.reserve(rows.size());
  for (const std::uint32_t row : rows) boxes.push_back(city.boxes[row]);
  return boxes;
}

}  // namespace manzana::baselines
