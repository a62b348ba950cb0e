#include "foliage/import/lsystem.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "foliage/import/json_members.h"

namespace manzana::foliage {
namespace {

std::size_t row(char symbol) { return static_cast<unsigned char>(symbol); }

void check_symbols(const std::string& string, const std::string& place) {
  int open = 0;
  for (std::size_t i = 0; i < string.size(); ++i) {
    const char c = string[i];
    const std::string at = " at symbol " + std::to_string(i + 1);
    if (c < ' ' || c > '~') fail_at(place, "holds what is no printable ASCII," + at);
    if (c == '(' || c == ')') fail_at(place, "parameters are not read: parenthesis" + at);
    if (c == '[') ++open;
    if (c == ']' && --open < 0) fail_at(place, "] without a [ before it," + at);
  }
  if (open > 0) fail_at(place, std::to_string(open) + " [ without a ]");
}

void read_rules(const Json& json, const std::string& place, LSystem& system) {
  if (!json.is_object()) fail_at(place, "is not an object");
  for (const auto& [key, value] : json.items()) {
    const std::string at = place + "." + key;
    if (key.size() != 1 || key[0] <= ' ' || key[0] > '~' || key == "[" || key == "]" || key == "(" || key == ")")
      fail_at(at, "is no symbol that a rule can replace");
    std::string& successor = system.rules[key[0]];
    read_value(value, at, successor);
    check_symbols(successor, at);
  }
}

void check_range(const Members& members, const char* name, double value, double low, double high) {
  if (!(value >= low && value <= high)) fail_at(members.key(name), "is out of range");
}

void read_look(Members& members, LSystemLook& look) {
  members.take("height_m", look.height_m).take("radius_m", look.radius_m).take("narrowing", look.narrowing);
  members.take("surface_steps", look.surface_steps).take("bark_rgb", look.bark_rgb);
  check_range(members, "height_m", look.height_m, 0.01, 200);
  check_range(members, "radius_m", look.radius_m, 1e-4, 10);
  check_range(members, "narrowing", look.narrowing, 0.01, 1);
  check_range(members, "surface_steps", look.surface_steps, 1e-3, 1e3);
  const Json* colours = members.array("colours");
  if (colours == nullptr) return;
  constexpr std::size_t kMost = 16;
  if (colours->empty() || colours->size() > kMost) fail_at(members.key("colours"), "holds none, or more than 16");
  look.colours.resize(colours->size());
  for (std::size_t i = 0; i < look.colours.size(); ++i)
    read_value((*colours)[i], members.key("colours") + "[" + std::to_string(i) + "]", look.colours[i]);
}

LSystem read_lsystem(const Json& json, const std::string& name) {
  LSystem system;
  system.name = name;
  Members members(json, name);
  members.need("axiom", system.axiom);
  check_symbols(system.axiom, members.key("axiom"));
  if (const Json* rules = members.find("rules")) read_rules(*rules, members.key("rules"), system);
  members.need("angle", system.angle_deg).need("n", system.steps);
  check_range(members, "angle", system.angle_deg, -360, 360);
  check_range(members, "n", system.steps, 0, kMaxSteps);
  read_look(members, system.look);
  members.find("source");
  members.find("expected");
  members.finish();
  return system;
}

/// How often each symbol occurs.
using Counts = std::array<std::uint64_t, 256>;

std::uint64_t sum(const Counts& counts) {
  std::uint64_t total = 0;
  for (const std::uint64_t count : counts) total += count;
  return total;
}

/// No count is over the limit here, and no rule longer than a file: nothing overflows.
Counts after_a_step(const LSystem& system, const Counts& counts) {
  Counts next{};
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const auto rule = counts[i] == 0 ? system.rules.end() : system.rules.find(static_cast<char>(i));
    if (rule == system.rules.end()) {
      next[i] += counts[i];
      continue;
    }
    for (const char symbol : rule->second) next[row(symbol)] += counts[i];
  }
  return next;
}

void check_growth(const LSystem& system, int steps) {
  Counts counts{};
  for (const char symbol : system.axiom) ++counts[row(symbol)];
  std::uint64_t total = sum(counts);
  for (int step = 1; step <= steps && total <= kMaxSymbols; ++step) {
    counts = after_a_step(system, counts);
    total += sum(counts);
    if (total > kMaxSymbols)
      fail_at(system.name, "grows to " + std::to_string(sum(counts)) + " symbols in step " + std::to_string(step) +
                               " of " + std::to_string(steps) + "; all steps together may have " +
                               std::to_string(kMaxSymbols));
  }
  if (total > kMaxSymbols) fail_at(system.name, "the axiom has " + std::to_string(total) + " symbols");
}

}  // namespace

std::vector<LSystem> parse_lsystems(std::string_view json) {
  const Json root = parse_json(json);
  if (!root.is_object()) throw std::runtime_error("the file is no object of L-systems");
  std::vector<LSystem> systems;
  for (const auto& [name, value] : root.items()) systems.push_back(read_lsystem(value, name));
  return systems;
}

std::string derive(const LSystem& system, int steps) {
  check_growth(system, steps);
  std::array<const std::string*, 256> rules{};
  for (const auto& [symbol, successor] : system.rules) rules[row(symbol)] = &successor;
  std::string string = system.axiom;
  for (int step = 0; step < steps; ++step) {
    std::string next;
    for (const char symbol : string) {
      const std::string* rule = rules[row(symbol)];
      rule != nullptr ? next.append(*rule) : next.append(1, symbol);
    }
    string = std::move(next);
  }
  return string;
}

}  // namespace manzana::foliage
