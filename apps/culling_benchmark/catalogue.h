#pragma once
/// All that can be measured by name: the cases of culling/baselines/cases.h, those of growth.h and trade.h, and city
/// files; and which structures each is for.
#include <memory>

#include "apps/culling_benchmark/options.h"
#include "culling/baselines/peer.h"

namespace manzana::culling_benchmark {

/// Beside 1M-1km bqr is also timed in this case, under this name: how the query grows with the city.
inline constexpr const char *kSmallerCase = "100k-1km", *kSmallerCity = "bqr-100k";

enum class Family : std::uint8_t { speed, growth, trade, file };

struct CaseInfo {
  std::string name, what;  ///< `what` is empty for files
  Family family = Family::file;
  bool cold = false;
  int threads = 1;
};
CaseInfo case_info(const std::string& name);
std::vector<std::string> names_of(Family family);

/// Not generated, nor built in.
bool is_from_file(const std::string& name);

/// Throws std::runtime_error when `name` is neither a case nor a file nor built in; cheap.
void look_up_case(const std::string& name);

/// The structures that a run measures in that case, bqr first.
std::vector<std::string> peers_for(const Options& options, const std::string& case_name);
/// Of culling/baselines/peer.h or of trade.h, or kSmallerCity. nullptr: no such structure.
const baselines::PeerInfo* peer_info(std::string_view slug);
/// Not when its library is missing, or the city would not fit the memory.
bool can_measure(const std::string& case_name, std::string_view peer);

/// Makes cities, and keeps the last one: neighbouring cases share it.
class Cities {
 public:
  /// Throws std::runtime_error ("FILE: what") for a file that cannot be read.
  std::shared_ptr<const baselines::City> get(const std::string& case_name, std::uint64_t seed);

 private:
  std::string key_;
  std::shared_ptr<const baselines::City> city_;
};

/// What tells one state of a case's city from another: "generated", or size and time of change of the file.
std::string scene_state(const std::string& case_name);

}  // namespace manzana::culling_benchmark
