#pragma once
/// On what, with what and when something was measured.
#include <string>

namespace manzana::apps {

struct Machine {
  std::string processor, caches, memory, system, compiler, simd, commit;
};
const Machine& this_machine();

/// Processor and cores in a few words, for a column.
std::string short_name(const Machine& machine);

std::string now_utc();  ///< 2026-01-31T12:00:00Z

}  // namespace manzana::apps
