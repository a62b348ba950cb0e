#pragma once
/// Plants as strings that rewrite themselves: each step replaces every symbol that has a rule by the rule's string, all
/// at once.  [Prusinkiewicz and Lindenmayer, The Algorithmic Beauty of Plants, 1990: ABOP; sections 1.2 and 1.6.3]
///   for (const LSystem& system : parse_lsystems(text)) plants.push_back(grow_plant(system));   //
///   foliage/import/turtle.h
/// The file is JSON:
///   {"NAME": {"axiom": "X", "rules": {"X": "F[+X]X", "F": "FF"}, "angle": 25.7, "n": 7}}
/// with, if wanted, "source" (a text), "expected" (what others counted; not read), and the keys of LSystemLook.
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace manzana::foliage {

/// What the strings of the book leave open.
struct LSystemLook {
  double height_m = 1;       ///< of the whole plant
  double radius_m = 0.004;   ///< of the first segment
  double narrowing = 0.7;    ///< ! multiplies the radius by it, in (0, 1]
  double surface_steps = 1;  ///< length of a predefined surface (~L, ~K), in steps of the turtle
  std::uint32_t bark_rgb = 0x6b5a48;
  std::vector<std::uint32_t> colours{0x4f7a35};  ///< of surfaces; ' goes to the next, and stays at the last
};

/// Symbols are printable ASCII but for parentheses: parameters are not read. Brackets are nested well in the axiom and
/// in every rule, hence in every string that follows.
struct LSystem {
  std::string name;
  std::string axiom;
  std::map<char, std::string> rules;
  double angle_deg = 0;  ///< in [-360, 360]
  int steps = 0;         ///< n
  LSystemLook look;
};

inline constexpr int kMaxSteps = 1000;
inline constexpr std::uint64_t kMaxSymbols = 4'000'000;  ///< of the strings of all steps together

/// In the order of their names. Throws std::runtime_error naming the place (key) of what is wrong.
std::vector<LSystem> parse_lsystems(std::string_view json);

/// The string after `steps` steps. How long it gets is counted first: throws std::runtime_error when all strings on the
/// way would have more than kMaxSymbols.
std::string derive(const LSystem& system, int steps);

}  // namespace manzana::foliage
