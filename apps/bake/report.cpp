#include "apps/bake/report.h"

#include <array>
#include <cstdio>

namespace manzana::bake {
namespace {

using namespace foliage;

template <class... Values>
std::string line(const char* format, Values... values) {
  std::array<char, 400> text;
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data() + std::string("\n");
}

/// Texts from files may hold anything: control characters would break lines and terminals.
std::string printable(std::string text) {
  for (char& c : text) c = static_cast<unsigned char>(c) < 32 || c == 127 ? ' ' : c;
  return text;
}

constexpr std::array<const char*, kReasons> kReasonNames{
    "the file's extras", "the material's name", "alpha", "the group's name", "branch ids", "shape", "colour",
    "what is left over"};

std::string by_level(const Plant& plant) {
  constexpr std::size_t kShown = 8;
  std::array<std::size_t, kShown> counts{};
  for (const Branch& branch : plant.branches) ++counts[std::min<std::size_t>(branch.level, kShown - 1)];
  std::string text;
  for (std::size_t i = 0; i < kShown; ++i)
    if (counts[i] > 0)
      text += (text.empty() ? "level " : ", level ") + std::to_string(i) + (i + 1 == kShown ? " and over: " : ": ") +
              std::to_string(counts[i]);
  return text;
}

std::size_t count(const Plant& plant, Organ organ) {
  std::size_t found = 0;
  for (const Terminal& terminal : plant.terminals) found += terminal.organ == organ ? 1 : 0;
  return found;
}

}  // namespace

std::string source_report(const PlantReading& reading) {
  const Plant& plant = reading.plant;
  std::string text = "plant      " + printable(plant.name) + "\n";
  text += line("branches   %zu, %zu triangles", plant.branches.size(), plant.mesh.bark.triangles());
  if (!plant.branches.empty()) text += line("           %s", by_level(plant).c_str());
  text += line("terminals  %zu, %zu triangles: %zu leaves, %zu flowers, %zu fruits", plant.terminals.size(),
               plant.mesh.leaves.triangles(), count(plant, Organ::leaf), count(plant, Organ::flower),
               count(plant, Organ::fruit));
  for (std::size_t i = 0; i < kReasons; ++i)
    if (reading.taken.branch[i] + reading.taken.terminal[i] > 0)
      text += line("           by %s: %zu triangles branch, %zu terminal", kReasonNames[i], reading.taken.branch[i],
                   reading.taken.terminal[i]);
  for (const std::string& note : reading.notes) text += "left out   " + printable(note) + "\n";
  return text;
}

std::string prepared_report(const PreparedPlant& plant) {
  std::string text =
      line("size       %.2f m high, %.2f m from the axis; %.1f m2 of leaves", static_cast<double>(plant.height_m),
           static_cast<double>(plant.crown_radius_m), static_cast<double>(plant.leaf_area_m2));
  for (std::size_t i = 0; i < plant.branch_levels.size(); ++i) {
    const BranchLevel& level = plant.branch_levels[i];
    text +=
        line("level %zu    %u branches in %u quads, %zu lines for the others, up to %.1f mm thick", i, level.branches,
             level.quads.size(), plant.lines.size() - level.first_line, 1000 * static_cast<double>(level.error_m));
  }
  text += line("leaves     %zu quads in %zu cells", plant.leaves.size(), plant.cells.size());
  text += line("points     %zu in %zu levels", plant.points.size(), plant.point_levels.size());
  return text;
}

}  // namespace manzana::bake
