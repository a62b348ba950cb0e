#include <algorithm>
#include <cmath>

#include "scenegraph/import/traffic_hash.h"
#include "scenegraph/import/traffic_signals.h"

namespace manzana {
namespace {

constexpr int kSlots = 128;         // a cycle
constexpr int kRepairs = 60;        // rounds of moving what is in conflict
constexpr int kPolishes = 2;        // rounds of moving everything
constexpr float kForbidden = 1e4f;  // seconds: what a conflict costs

int wrap(int slot) { return ((slot % kSlots) + kSlots) % kSlots; }

class SlotChooser {
 public:
  SlotChooser(const std::vector<Ride>& rides, const std::vector<Conflict>& conflicts, double cycle, std::uint64_t seed)
      : rides_(rides), cycle_(cycle), seed_(seed), slot_(rides.size(), -1), lead_(rides.size()), slack_(rides.size()) {
    for (std::size_t r = 0; r < rides.size(); ++r) {
      const double free = lane_time(rides[r].profile, 1e9);
      lead_[r] = rides[rides[r].previous].way_time() + free;
      slack_[r] = lane_time(rides[r].profile, slowest_cruise(cycle)) - free;
    }
    index_conflicts(conflicts);
  }

  Slots run() {
    for (std::uint32_t r = 0; r < rides_.size(); ++r) choose(r, 0);
    repair();
    for (int round = 0; round < kPolishes; ++round)
      for (std::uint32_t r = 0; r < rides_.size(); ++r) choose(r, 0);
    return result();
  }

 private:
  struct Against {
    std::uint32_t other;
    int low, high;  // slots of this ride less the other's that are not free
  };

  void index_conflicts(const std::vector<Conflict>& conflicts) {
    first_.assign(rides_.size() + 1, 0);
    for (const Conflict& c : conflicts) ++first_[c.a + 1], ++first_[c.b + 1];
    for (std::size_t r = 0; r < rides_.size(); ++r) first_[r + 1] += first_[r];
    against_.resize(2 * conflicts.size());
    std::vector<std::uint32_t> at(first_.begin(), first_.end() - 1);
    for (const Conflict& c : conflicts) {
      const int low = static_cast<int>(std::floor(c.low / cycle_ * kSlots));
      const int high = std::min(static_cast<int>(std::ceil(c.high / cycle_ * kSlots)), low + kSlots - 1);
      against_[at[c.a]++] = {c.b, low, high};
      against_[at[c.b]++] = {c.a, -high, -low};
    }
  }

  /// Seconds above the free time, when this ride and the one before it have these slots.
  double delay(std::uint32_t r, int previous, int slot) const {
    const double wait = std::fmod((slot - previous) * (cycle_ / kSlots) - lead_[r], cycle_);
    const double positive = wait < 0 ? wait + cycle_ : wait;
    return positive > cycle_ - 1e-7 ? 0 : positive;
  }
  float delay_cost(std::uint32_t r, int previous, int slot) const {
    const double d = delay(r, previous, slot);
    return float(d) + (d > slack_[r] ? kForbidden : 0.0f);
  }

  bool free(std::uint32_t r, const Against& against) const {
    const int other = slot_[against.other];
    return other < 0 || wrap(slot_[r] - other - against.low) > against.high - against.low;
  }

  bool good(std::uint32_t r) const {
    if (delay(r, slot_[rides_[r].previous], slot_[r]) > slack_[r]) return false;
    return std::all_of(against_.begin() + first_[r], against_.begin() + first_[r + 1],
                       [&](const Against& against) { return free(r, against); });
  }

  void choose(std::uint32_t r, float noise) {
    float cost[kSlots] = {};
    for (std::uint32_t i = first_[r]; i < first_[r + 1]; ++i)
      if (const int other = slot_[against_[i].other]; other >= 0)
        for (int k = against_[i].low; k <= against_[i].high; ++k) cost[wrap(other + k)] += kForbidden;
    const std::uint32_t next = rides_[r].next;
    const int before = slot_[rides_[r].previous], after = slot_[next];
    for (int k = 0; k < kSlots; ++k) {
      if (before >= 0 && next != r) cost[k] += delay_cost(r, before, k);
      if (after >= 0 && next != r) cost[k] += delay_cost(next, k, after);
      if (noise > 0) cost[k] += noise * float(unit_hash(seed_, ++drawn_));
    }
    slot_[r] = static_cast<int>(std::min_element(cost, cost + kSlots) - cost);
  }

  void repair() {
    std::vector<std::uint32_t> bad;
    for (int round = 0; round < kRepairs; ++round) {
      std::vector<std::uint32_t> todo = round == 0 ? all() : std::move(bad);
      bad.clear();
      for (const std::uint32_t r : todo)
        if (!good(r)) bad.push_back(r);
      if (bad.empty()) return;
      for (const std::uint32_t r : bad) move_with_neighbours(r, kForbidden * 0.06f * float(round));
      add_neighbours(bad);
    }
  }

  std::vector<std::uint32_t> all() const {
    std::vector<std::uint32_t> out(rides_.size());
    for (std::uint32_t r = 0; r < out.size(); ++r) out[r] = r;
    return out;
  }

  void move_with_neighbours(std::uint32_t r, float noise) {
    choose(r, noise);
    if (good(r)) return;
    const std::uint32_t count = first_[r + 1] - first_[r];
    if (count > 0) choose(against_[first_[r] + hash(seed_, ++drawn_) % count].other, noise);
    choose(r, 0);
  }

  /// All that a move may have put out of place.
  void add_neighbours(std::vector<std::uint32_t>& rides) const {
    const std::size_t count = rides.size();
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t r = rides[i];
      rides.push_back(rides_[r].next);
      rides.push_back(rides_[r].previous);
      for (std::uint32_t k = first_[r]; k < first_[r + 1]; ++k) {
        rides.push_back(against_[k].other);
        rides.push_back(rides_[against_[k].other].next);
      }
    }
    std::sort(rides.begin(), rides.end());
    rides.erase(std::unique(rides.begin(), rides.end()), rides.end());
  }

  Slots result() const {
    Slots out{cycle_, {}, {}, {}};
    for (std::uint32_t r = 0; r < rides_.size(); ++r) {
      out.slot.push_back(slot_[r] * cycle_ / kSlots);
      out.delay.push_back(delay(r, slot_[rides_[r].previous], slot_[r]));
      if (!good(r)) out.failed.push_back(r);
    }
    return out;
  }

  const std::vector<Ride>& rides_;
  double cycle_;
  std::uint64_t seed_, drawn_ = 0;
  std::vector<int> slot_;
  std::vector<double> lead_, slack_;  // seconds: from the slot before to the earliest slot; from that to the latest
  std::vector<std::uint32_t> first_;  // rides + 1: rows of against_
  std::vector<Against> against_;
};

}  // namespace

Slots choose_slots(const std::vector<Ride>& rides, const std::vector<Conflict>& conflicts, double cycle,
                   std::uint64_t seed) {
  return SlotChooser(rides, conflicts, cycle, seed).run();
}

}  // namespace manzana
