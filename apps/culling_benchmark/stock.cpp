#include "apps/culling_benchmark/stock.h"

#include <chrono>

namespace manzana::culling_benchmark {
namespace {

Stock::Item build(const baselines::PeerInfo& info, const baselines::City& city) {
  const auto start = std::chrono::steady_clock::now();
  auto peer = info.make(city);
  return {std::move(peer), std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count()};
}

}  // namespace

const Stock::Item& Stock::get(const baselines::PeerInfo& info, const std::shared_ptr<const baselines::City>& city,
                              std::size_t copy) {
  if (city_ != city) items_.clear();
  city_ = city;
  auto& copies = items_[info.slug];
  while (copies.size() <= copy) copies.push_back(build(info, *city));
  return copies[copy];
}

}  // namespace manzana::culling_benchmark
