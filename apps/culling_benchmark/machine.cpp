#include "apps/culling_benchmark/machine.h"

#include <sys/utsname.h>
#include <unistd.h>

#include <array>
#include <ctime>
#include <fstream>
#include <thread>

#include "commit.h"  // written by every build
#include "culling/cull.h"

namespace manzana::culling_benchmark {
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
  static const Machine machine{processor(),   memory(), system_name(), compiler(), culling::simd_target(),
                               MANZANA_COMMIT};
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

}  // namespace manzana::culling_benchmark
