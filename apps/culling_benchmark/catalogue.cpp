#include "apps/culling_benchmark/catalogue.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <stdexcept>

#include "apps/culling_benchmark/city_file.h"
#include "apps/culling_benchmark/growth.h"
#include "apps/culling_benchmark/trade.h"
#include "culling/baselines/cases.h"

namespace manzana::culling_benchmark {
namespace {

using baselines::City;

City make_city_for(const std::string& name, std::uint64_t seed) {
  if (const auto* speed = baselines::find_case(name)) return make_city(*speed, seed);
  if (const Growth* growth = find_growth(name)) return baselines::make_city(growth->objects, seed);
  if (const TradePlace* place = find_trade_place(name))
    return moved(baselines::make_city(10'000, seed), place->moved_by);
  return read_city(name, seed);
}

/// Cases with the same key have the same city.
std::string city_key(const std::string& name) {
  if (const Growth* growth = find_growth(name)) return std::to_string(growth->objects) + " objects";
  return baselines::find_case(name) != nullptr ? name.substr(0, name.find('-')) : name;
}

template <class Items>
std::vector<std::string> names_in(const Items& items) {
  std::vector<std::string> names;
  for (const auto& item : items) names.emplace_back(item.name);
  return names;
}

}  // namespace

CaseInfo case_info(const std::string& name) {
  if (const auto* speed = baselines::find_case(name))
    return {name, std::string(speed->what), Family::speed, speed->cold, 1};
  if (const Growth* growth = find_growth(name))
    return {name, growth->what, Family::growth, growth->cold, growth->threads};
  if (const TradePlace* place = find_trade_place(name)) return {name, place->what, Family::trade, false, 1};
  return {name, {}, Family::file, false, 1};
}

std::vector<std::string> names_of(Family family) {
  if (family == Family::speed) return names_in(baselines::cases());
  if (family == Family::growth) return names_in(growth_cases());
  return family == Family::trade ? names_in(trade_places()) : std::vector<std::string>{};
}

bool is_from_file(const std::string& name) {
  return case_info(name).family == Family::file && !name.starts_with("builtin:");
}

void look_up_case(const std::string& name) {
  if (is_from_file(name) && !std::filesystem::exists(name))
    throw std::runtime_error(name + ": no such case (see --list), nor a file");
}

std::vector<std::string> peers_for(const Options& options, const std::string& case_name) {
  const Family family = case_info(case_name).family;
  std::vector<std::string> peers{"bqr"};
  if (family == Family::trade)
    for (const auto& variant : trade_peers()) peers.emplace_back(variant.slug);
  else
    for (const std::string& slug : options.peers) {
      const auto followed = growth_peers();
      const bool wanted =
          family != Family::growth || std::find(followed.begin(), followed.end(), slug) != followed.end();
      if (wanted && slug != "bqr") peers.push_back(slug);
    }
  if (case_name == "1M-1km") peers.emplace_back(kSmallerCity);
  return peers;
}

const baselines::PeerInfo* peer_info(std::string_view slug) {
  static const baselines::PeerInfo smaller{kSmallerCity, "bqr, where there are 100 000 objects",
                                           baselines::Grain::object, true, baselines::find_peer("bqr")->make};
  if (slug == kSmallerCity) return &smaller;
  if (const auto* peer = baselines::find_peer(slug)) return peer;
  const auto variants = trade_peers();
  const auto found = std::find_if(variants.begin(), variants.end(), [&](const auto& p) { return p.slug == slug; });
  return found == variants.end() ? nullptr : &*found;
}

bool can_measure(const std::string& case_name, std::string_view peer) {
  const baselines::PeerInfo* info = peer_info(peer);
  const Growth* growth = find_growth(case_name);
  return info != nullptr && info->available && (growth == nullptr || fits_memory(*growth));
}

std::shared_ptr<const City> Cities::get(const std::string& case_name, std::uint64_t seed) {
  const std::string key = city_key(case_name) + " " + std::to_string(seed);
  if (city_ != nullptr && key == key_) return city_;
  city_.reset();  // not two of the large ones at once
  city_ = std::make_shared<const City>(make_city_for(case_name, seed));
  key_ = key;
  return city_;
}

std::string scene_state(const std::string& case_name) {
  if (!is_from_file(case_name)) return "generated";
  if (!std::filesystem::exists(case_name)) return "missing";
  const auto changed = std::filesystem::last_write_time(case_name).time_since_epoch();
  return std::to_string(std::filesystem::file_size(case_name)) + "@" +
         std::to_string(std::chrono::duration_cast<std::chrono::seconds>(changed).count());
}

}  // namespace manzana::culling_benchmark
