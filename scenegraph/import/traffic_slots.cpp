#include <algorithm>
#include <cmath>

#include "culling/hash.h"
#include "scenegraph/import/traffic_signals.h"

namespace manzana {
namespace {

constexpr int kSlots = 128;         // a cycle; a power of two
constexpr int kRepairs = 180;       // rounds of moving what is in conflict
constexpr int kWave = 12;           // rounds from no noise to the most
constexpr int kPolishes = 2;        // rounds of moving everything
constexpr double kTied = 0.2;       // of the cycle: lanes with less room for delay have none
constexpr float kForbidden = 1e4f;  // seconds: what a conflict costs

int wrap(int slot) { return slot & (kSlots - 1); }

/// Rides that follow each other without a delay between them: one slot for all. Delays are on the first one's lane.
/// Slots are counted from the times that rides would have without any delay since their circuit's start, so only there
/// the lap's rest is left over: `lead` whole slots, `early` seconds.
struct Group {
  std::uint32_t first = 0, previous = 0, next = 0;  // first: ride; the others: groups
  int lead = 0;
  double early = 0, slack = 0;
};

class SlotChooser {
 public:
  SlotChooser(const std::vector<Ride>& rides, const std::vector<Conflict>& conflicts, double cycle, std::uint64_t seed)
      : rides_(rides), cycle_(cycle), slot_seconds_(cycle / kSlots), seed_(seed) {
    for (const Ride& ride : rides) {
      free_.push_back(lane_time(ride.profile, kNoCruise));
      slack_.push_back(lane_time(ride.profile, slowest_cruise(cycle)) - free_.back());
    }
    make_groups();
    index_conflicts(conflicts);
  }

  Slots run() {
    slot_.assign(groups_.size(), -1);
    for (std::uint32_t g = 0; g < groups_.size(); ++g) choose(g, 0);
    repair();
    for (int round = 0; round < kPolishes; ++round)
      for (std::uint32_t g = 0; g < groups_.size(); ++g) choose(g, 0);
    return result();
  }

 private:
  struct Against {
    std::uint32_t ride, other;  // ours, and the other's group
    int low, high;              // slots of this group less the other's that are not free
  };

  /// From the time at the end of the lane before to the time at the end of this one.
  double lead_seconds(std::uint32_t r) const { return rides_[rides_[r].previous].way_time() + free_[r]; }

  void make_groups() {
    group_.assign(rides_.size(), kNone);
    base_.assign(rides_.size(), 0);
    for (std::uint32_t r = 0; r < rides_.size(); ++r)
      if (group_[r] == kNone) make_groups_of_circuit(r);
  }

  void make_groups_of_circuit(std::uint32_t any) {
    std::uint32_t start = any;
    for (std::uint32_t r = rides_[any].next; r != any; r = rides_[r].next)
      if (slack_[r] > slack_[start]) start = r;
    const auto first = static_cast<std::uint32_t>(groups_.size());
    std::uint32_t r = start;
    do {
      if (r == start || slack_[r] >= kTied * cycle_) add_group(r, first);
      if (r != start) base_[r] = base_[rides_[r].previous] + lead_seconds(r);
      group_[r] = static_cast<std::uint32_t>(groups_.size() - 1);
      r = rides_[r].next;
    } while (r != start);
    const double lap = (base_[rides_[start].previous] + lead_seconds(start)) / slot_seconds_;
    groups_[first].lead = static_cast<int>(static_cast<std::int64_t>(std::ceil(lap - 1e-6)) & (kSlots - 1));
    groups_[first].early = std::max(0.0, std::ceil(lap - 1e-6) - lap) * slot_seconds_;
    groups_[first].previous = static_cast<std::uint32_t>(groups_.size() - 1);
  }

  void add_group(std::uint32_t r, std::uint32_t first) {
    const auto id = static_cast<std::uint32_t>(groups_.size());
    if (id > first) groups_.back().next = id;
    groups_.push_back({r, id > first ? id - 1 : id, first, 0, 0, slack_[r]});
  }

  void index_conflicts(const std::vector<Conflict>& conflicts) {
    first_.assign(groups_.size() + 1, 0);
    for (const Conflict& c : conflicts) ++first_[group_[c.a] + 1], ++first_[group_[c.b] + 1];
    for (std::size_t g = 0; g < groups_.size(); ++g) first_[g + 1] += first_[g];
    against_.resize(2 * conflicts.size());
    std::vector<std::uint32_t> at(first_.begin(), first_.end() - 1);
    for (const Conflict& c : conflicts) {
      const double apart = std::fmod(base_[c.b] - base_[c.a], cycle_);
      const int low = static_cast<int>(std::floor((c.low + apart) / slot_seconds_));
      const int high = std::min(static_cast<int>(std::ceil((c.high + apart) / slot_seconds_)), low + kSlots - 1);
      against_[at[group_[c.a]]++] = {c.a, group_[c.b], low, high};
      against_[at[group_[c.b]]++] = {c.b, group_[c.a], -high, -low};
    }
  }

  /// Seconds above the free time on the lane of the group's first ride.
  double delay(std::uint32_t g) const {
    const Group& group = groups_[g];
    return wrap(slot_[g] - slot_[group.previous] - group.lead) * slot_seconds_ + group.early;
  }
  bool too_late(std::uint32_t g) const { return delay(g) > groups_[g].slack; }

  bool free(std::uint32_t g, const Against& against) const {
    const int other = slot_[against.other];
    return other < 0 || wrap(slot_[g] - other - against.low) > against.high - against.low;
  }

  bool good(std::uint32_t g) const {
    return !too_late(g) && std::all_of(against_.begin() + first_[g], against_.begin() + first_[g + 1],
                                       [&](const Against& against) { return free(g, against); });
  }

  /// Adds what it costs that group g waits, to the slots that `moved` gives for 0, 1, ... slots of waiting.
  template <class Moved>  // int(int waited)
  void add_delays(float* cost, const Group& group, Moved&& moved) const {
    for (int waited = 0; waited < kSlots; ++waited) {
      const double seconds = waited * slot_seconds_ + group.early;
      cost[wrap(moved(waited))] += float(seconds) + (seconds > group.slack ? kForbidden : 0.0f);
    }
  }

  void choose(std::uint32_t g, float noise) {
    float cost[kSlots] = {};
    for (std::uint32_t i = first_[g]; i < first_[g + 1]; ++i)
      if (const int other = slot_[against_[i].other]; other >= 0 && against_[i].other != g)
        for (int k = against_[i].low; k <= against_[i].high; ++k) cost[wrap(other + k)] += kForbidden;
    const Group &group = groups_[g], &next = groups_[group.next];
    const int before = slot_[group.previous], after = slot_[group.next];
    if (before >= 0 && group.next != g)
      add_delays(cost, group, [&](int waited) { return before + group.lead + waited; });
    if (after >= 0 && group.next != g) add_delays(cost, next, [&](int waited) { return after - next.lead - waited; });
    for (int k = 0; noise > 0 && k < kSlots; ++k) cost[k] += noise * float(hash_unit(seed_, ++drawn_));
    slot_[g] = static_cast<int>(std::min_element(cost, cost + kSlots) - cost);
  }

  void repair() {
    std::vector<std::uint32_t> bad(groups_.size());
    for (std::uint32_t g = 0; g < bad.size(); ++g) bad[g] = g;
    for (int round = 0; round < kRepairs; ++round) {
      bad.erase(std::remove_if(bad.begin(), bad.end(), [&](std::uint32_t g) { return good(g); }), bad.end());
      if (bad.empty()) return;
      for (const std::uint32_t g : bad) move_with_neighbour(g, kForbidden * 0.06f * float(round % kWave));
      add_neighbours(bad);
    }
  }

  void move_with_neighbour(std::uint32_t g, float noise) {
    choose(g, noise);
    const std::uint32_t count = first_[g + 1] - first_[g];
    if (count == 0 || good(g)) return;
    choose(against_[first_[g] + hash_bits(seed_, ++drawn_) % count].other, noise);
    choose(g, 0);
  }

  /// All that a move may have put out of place.
  void add_neighbours(std::vector<std::uint32_t>& groups) const {
    const std::size_t count = groups.size();
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t g = groups[i];
      groups.insert(groups.end(), {groups_[g].next, groups_[g].previous});
      for (std::uint32_t k = first_[g]; k < first_[g + 1]; ++k)
        groups.insert(groups.end(), {against_[k].other, groups_[against_[k].other].next});
    }
    std::sort(groups.begin(), groups.end());
    groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  }

  Slots result() const {
    Slots out{cycle_, {}, std::vector<double>(rides_.size(), 0), {}};
    for (std::uint32_t r = 0; r < rides_.size(); ++r)
      out.slot.push_back(std::fmod(base_[r] + slot_[group_[r]] * slot_seconds_, cycle_));
    for (std::uint32_t g = 0; g < groups_.size(); ++g) {
      out.delay[groups_[g].first] = delay(g);
      if (too_late(g)) out.failed.push_back(groups_[g].first);
      for (std::uint32_t k = first_[g]; k < first_[g + 1]; ++k)
        if (!free(g, against_[k])) out.failed.push_back(against_[k].ride);
    }
    return out;
  }

  static constexpr std::uint32_t kNone = ~std::uint32_t{0};
  const std::vector<Ride>& rides_;
  double cycle_, slot_seconds_;
  std::uint64_t seed_, drawn_ = 0;
  std::vector<double> free_, slack_, base_;  // by ride, seconds; base_: since the circuit's start, without delays
  std::vector<std::uint32_t> group_;         // by ride
  std::vector<Group> groups_;
  std::vector<int> slot_;             // by group; -1: none yet
  std::vector<std::uint32_t> first_;  // groups + 1: rows of against_
  std::vector<Against> against_;
};

}  // namespace

Slots choose_slots(const std::vector<Ride>& rides, const std::vector<Conflict>& conflicts, double cycle,
                   std::uint64_t seed) {
  return SlotChooser(rides, conflicts, cycle, seed).run();
}

}  // namespace manzana
