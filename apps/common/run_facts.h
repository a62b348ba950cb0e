#pragma once
/// What rows of measurements say of their run, whatever was measured: rows derive from these, and get their columns.
///   struct Row : RunFacts, Calm { double ms; };
///   static const auto columns = joined<Row>({run_columns<Row>(), {{"ms", "ms", "median", &Row::ms}},
///   calm_columns<Row>()});
#include <string>
#include <vector>

#include "apps/common/conditions.h"
#include "apps/common/csv.h"
#include "apps/common/machine.h"

namespace manzana::apps {

struct RunFacts {
  std::string commit, date, machine, mode;  ///< mode: quick or full
};

/// Of this program on this machine. The date is that of the call.
inline RunFacts run_facts(const std::string& mode) {
  return {this_machine().commit, now_utc(), short_name(this_machine()), mode};
}

/// Whatever the date: measured again, it would be the same.
inline bool same_run(const RunFacts& a, const RunFacts& b) {
  return a.commit == b.commit && a.machine == b.machine && a.mode == b.mode;
}

template <class Row>
std::vector<Column<Row>> run_columns() {
  return {{"commit", "", "what the program was built from; -dirty and a hash: with changes", &Row::commit},
          {"date", "UTC", "when the row was finished", &Row::date},
          {"machine", "", "processor and number of cores", &Row::machine},
          {"mode", "", "quick or full", &Row::mode}};
}

template <class Row>
std::vector<Column<Row>> calm_columns() {
  return {{"dirty", "", "1: the machine was disturbed in every attempt", &Row::dirty},
          {"attempts", "", "how often it was measured; the last counts", &Row::attempts},
          {"calibration_ms", "ms", "a loop of fixed work, the slower of before and after", &Row::calibration_ms},
          {"others_cores", "cores", "taken by other programs meanwhile", &Row::others_cores},
          {"steal", "", "share of processor time taken by other guests of the host", &Row::steal}};
}

template <class Row>
std::vector<Column<Row>> joined(std::initializer_list<std::vector<Column<Row>>> parts) {
  std::vector<Column<Row>> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace manzana::apps
