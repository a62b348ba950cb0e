#pragma once
/// Structures that a process has built. They stay while the city does, so that cases of one city share them.
///   const Stock::Item& item = stock.get(info, city, 0);
#include <deque>
#include <map>
#include <memory>
#include <string_view>

#include "culling/baselines/peer.h"

namespace manzana::culling_benchmark {

class Stock {
 public:
  struct Item {
    std::unique_ptr<baselines::Peer> peer;
    double build_ms = 0;
  };
  /// The copy of that number, from 0; builds what is not there yet. Another city than the last ends all items.
  const Item& get(const baselines::PeerInfo& info, const std::shared_ptr<const baselines::City>& city,
                  std::size_t copy);

 private:
  std::shared_ptr<const baselines::City> city_;
  std::map<std::string_view, std::deque<Item>> items_;
};

}  // namespace manzana::culling_benchmark
