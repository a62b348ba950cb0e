#include "apps/common/machine.h"

#include <sys/utsname.h>
#include <unistd.h>

#include <array>
#include <ctime>
#include <fstream>
#include <thread>

#include "commit.h"  // written by every build
#include "culling/cull.h"

namespace manzana::apps {
namespace {

/// The value of "key : value" in a file of /proc; empty where there is none.
std::string proc_value(const char* file, const std::string& key) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const auto colon = line.find(':');
    if (!line.starts_with(key) || colon == std::string::npos) continue;
    const auto from = line.find_first_not_of(" \t", colon + 1);
    return from == std::string::npos ? std::string() : line.substr(from);
  }
  return {};
}

std::string processor() {
  const std::string model = proc_value("/proc/cpuinfo", "model name");
  return (model.empty() ? "unknown processor" : model) + ", " + std::to_string(std::thread::hardware_concurrency()) +
         " cores";
}

/// "32K, 1024K, 32768K" of the first core, without that for instructions; empty where there is no /sys.
std::string caches() {
  std::string text;
  for (const int index : {0, 2, 3}) {
    std::ifstream in("/sys/devices/system/cpu/cpu0/cache/index" + std::to_string(index) + "/size");
    if (std::string size; in >> size) text += (text.empty() ? "" : ", ") + size;
  }
  return text;
}

/// Highway's AVX3 is what others call AVX-512.
std::string simd() {
  const std::string target = culling::simd_target();
  return target.starts_with("AVX3") ? target + " (AVX-512)" : target;
}

std::string memory() {
  const double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  return std::to_string(static_cast<int>(bytes / (1 << 30) + 0.5)) + " GiB";
}

std::string system_name() {
  utsname names{};
  uname(&names);
  return std::string(names.sysname) + " " + names.release + ", " + names.machine;
}

std::string compiler() {
#if defined(__clang__)
  return "clang " __clang_version__ ", " MANZANA_BUILD;
#else
  return "g++ " __VERSION__ ", " MANZANA_BUILD;
#endif
}

}  // namespace

const Machine& this_machine() {
  static const Machine machine{processor(), caches(), memory(), system_name(), compiler(), simd(), MANZANA_COMMIT};
  return machine;
}

std::string short_name(const Machine& machine) { return machine.processor; }

std::string now_utc() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text.data();
}

}  // namespace manzana::apps
