#include "apps/walkthrough/endurance.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <fstream>

namespace manzana::walkthrough {
namespace {

double resident_mb() {
  double all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) * 1e-6;
}

void find_in_all_blocks(const Scene& scene, std::uint64_t tick, std::vector<CarState>& found) {
  found.clear();
  for (std::uint32_t block = 0; block < scene.blocks.size(); ++block) cars_of_block(scene.traffic, block, tick, found);
}

}  // namespace

void Endurance::see(const Scene& scene, double seconds, std::size_t device_bytes, int lap) {
  cars = scene.traffic.cars();
  find_in_all_blocks(scene, ticks(seconds), found);
  rows.push_back({seconds / 3600, found.size(), static_cast<double>(device_bytes) * 1e-6, resident_mb(), lap});
}

std::string to_text(const Endurance& day) {
  std::string text = "hours     cars  device MB    host MB\n";
  const std::size_t step = std::max<std::size_t>(1, day.rows.size() / 12);
  for (std::size_t i = step - 1; i < day.rows.size(); i += step) {
    const Endurance::Row& row = day.rows[i];
    char line[96];
    std::snprintf(line, sizeof line, "%5.1f %8llu %10.3f %10.1f\n", row.hours,
                  static_cast<unsigned long long>(row.cars), row.device_mb, row.host_mb);
    text += line;
  }
  return text;
}

std::optional<std::string> drift(const Endurance& day) {
  const Endurance::Row* before = nullptr;
  for (const Endurance::Row& row : day.rows) {
    const std::string when = " after " + std::to_string(row.hours) + " hours";
    if (row.cars != day.cars) return std::to_string(row.cars) + " of " + std::to_string(day.cars) + " cars" + when;
    if (row.lap < 2) continue;
    if (before == nullptr) before = &row;
    if (row.device_mb != before->device_mb) return "the device holds " + std::to_string(row.device_mb) + " MB" + when;
    if (row.host_mb > before->host_mb * 1.01 + 2) return "the host holds " + std::to_string(row.host_mb) + " MB" + when;
  }
  return {};
}

}  // namespace manzana::walkthrough
