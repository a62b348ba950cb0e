#pragma once
/// Makes the packs that far trees ask for, when they ask, one after the other beside what is drawn; keeps them on disk.
///   PackMaker maker(plants);
///   maker.want(renderer.packs_wanted());                              // each frame
///   while (auto made = maker.take()) renderer.add_pack(made->plant, std::move(made->pack));
#include <condition_variable>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <thread>
#include <vector>

#include "foliage/ldm_pack.h"
#include "foliage/prepared_plant.h"

namespace manzana::walkthrough {

class PackMaker {
 public:
  struct Made {
    std::uint32_t plant;
    foliage::LdmPack pack;
  };

  /// The plants must outlive it.
  explicit PackMaker(std::span<const foliage::PreparedPlant> plants);
  ~PackMaker();  ///< waits for the pack at hand
  PackMaker(const PackMaker&) = delete;
  PackMaker& operator=(const PackMaker&) = delete;

  /// Each plant is made once, whoever asks how often.
  void want(std::span<const std::uint32_t> plants);
  std::optional<Made> take();           ///< of those that are done
  std::optional<Made> wait_and_take();  ///< none: all that are wanted have been taken, or cannot be made

 private:
  void work();
  std::optional<Made> take_locked();

  std::span<const foliage::PreparedPlant> plants_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::set<std::uint32_t> known_;
  std::vector<std::uint32_t> todo_;
  std::vector<Made> done_;
  bool busy_ = false, stop_ = false;
  std::thread thread_;  // the last: it uses the others
};

}  // namespace manzana::walkthrough
