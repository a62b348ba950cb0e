#include "apps/walkthrough/pack_maker.h"

#include <cstdio>
#include <functional>

#include "foliage/gl/ldm_sampler.h"
#include "foliage/import/ldm_cache.h"
#include "foliage/make_ldm.h"
#include "gl/context.h"
#include "scenegraph/draw/far_trees.h"

namespace manzana::walkthrough {
namespace {

/// Far pictures have a quarter of the finest pixels a side: with 2 x 2 samples in each of those they have 64.
constexpr int kFine = 2;

void tell(const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); }

foliage::LdmPack make(const foliage::PreparedPlant& plant) {
  const auto sample = [&] {
    foliage::LdmSamplerGl sampler(plant, kFine);
    return make_ldm_pack(ldm_ball(plant), draw::kFarPack, std::ref(sampler));
  };
  return load_or_make_pack(plant, foliage::default_cache_folder(), draw::kFarPack, sample, tell);
}

}  // namespace

PackMaker::PackMaker(std::span<const foliage::PreparedPlant> plants) : plants_(plants), thread_([this] { work(); }) {}

PackMaker::~PackMaker() {
  {
    const std::scoped_lock lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void PackMaker::want(std::span<const std::uint32_t> plants) {
  if (plants.empty()) return;
  const std::scoped_lock lock(mutex_);
  for (const std::uint32_t plant : plants)
    if (known_.insert(plant).second) todo_.push_back(plant);
  changed_.notify_all();
}

std::optional<PackMaker::Made> PackMaker::take_locked() {
  if (done_.empty()) return std::nullopt;
  std::optional<Made> made(std::move(done_.front()));
  done_.erase(done_.begin());
  return made;
}

std::optional<PackMaker::Made> PackMaker::take() {
  const std::scoped_lock lock(mutex_);
  return take_locked();
}

std::optional<PackMaker::Made> PackMaker::wait_and_take() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !done_.empty() || (todo_.empty() && !busy_); });
  return take_locked();
}

/// The context is the thread's own: GL of the one that draws is left alone.
void PackMaker::work() {
  std::optional<gl::HeadlessContext> context;
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return stop_ || !todo_.empty(); });
    if (stop_) return;
    const std::uint32_t plant = todo_.front();
    todo_.erase(todo_.begin());
    busy_ = true;
    lock.unlock();
    std::optional<foliage::LdmPack> pack;
    try {
      if (!context) context.emplace();
      pack = make(plants_[plant]);
    } catch (const std::exception& error) {
      tell(plants_[plant].name + ": far trees stay as near ones are: " + error.what());
    }
    lock.lock();
    busy_ = false;
    if (pack) done_.push_back({plant, std::move(*pack)});
    changed_.notify_all();
  }
}

}  // namespace manzana::walkthrough
