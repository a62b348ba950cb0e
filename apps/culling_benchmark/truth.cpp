#include "apps/culling_benchmark/truth.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <fstream>
#include <optional>
#include <span>

#include "apps/common/clock.h"
#include "apps/common/machine.h"
#include "culling/baselines/exact.h"
#include "culling/hash.h"
#include "files/whole_file.h"

namespace manzana::culling_benchmark {
namespace {

using baselines::Answer;
using baselines::City;
using baselines::Peer;

std::uint64_t ones(std::span<const std::uint64_t> bits) {
  std::uint64_t n = 0;
  for (const std::uint64_t word : bits) n += static_cast<std::uint64_t>(std::popcount(word));
  return n;
}

/// On all cores.
std::vector<std::uint64_t> seen_bits(const culling::View& view, std::span<const culling::BoxD> boxes) {
  constexpr std::size_t kWord = 64;
  const culling::ExactView exact = culling::make_exact(view);
  std::vector<std::uint64_t> bits((boxes.size() + kWord - 1) / kWord);
  tbb::parallel_for(std::size_t{0}, bits.size(), [&](std::size_t word) {
    for (std::size_t i = word * kWord; i < std::min(boxes.size(), (word + 1) * kWord); ++i)
      if (exactly_overlaps(exact, boxes[i])) bits[word] |= std::uint64_t{1} << i % kWord;
  });
  return bits;
}

/// Clears the bit of each object that the answer holds; what is left was missed.
Counts compare(const Answer& answer, const Peer& peer, const City& city, std::vector<std::uint64_t>& left) {
  const auto order = peer.order();
  Counts counts;
  for (const culling::ObjectRun& run : answer.runs) {
    counts.accepted += run.last - run.first;
    for (std::uint32_t at = run.first; at < run.last; ++at) {
      const std::uint32_t row = order.empty() ? at : order[at];
      counts.triangles += city.triangles[row];
      left[row / 64] &= ~(std::uint64_t{1} << row % 64);
    }
  }
  counts.missed = ones(left);
  return counts;
}

/// Of all that the truth depends on.
std::string key_of(const Workload& work) {
  std::uint64_t key = 0;
  const auto add = [&](const auto& value) {
    for (const std::uint64_t word : std::bit_cast<std::array<std::uint64_t, sizeof(value) / 8>>(value))
      key = hash_bits(key, word);
  };
  for (const culling::BoxD& box : work.city->boxes) add(box);
  for (const culling::View& view : work.views) add(view);
  for (const char c : apps::this_machine().commit) key = hash_bits(key, static_cast<std::uint64_t>(c));
  return std::to_string(key);
}

std::size_t words_of(const Workload& work) { return (work.city->objects() + 63) / 64; }

/// Nothing when there is no such file, or only a part of it.
std::optional<Truth> read_truth(const Workload& work, const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  Truth truth;
  for (std::size_t frame = 0; frame < work.views.size(); ++frame) {
    truth.bits.emplace_back(words_of(work));
    const auto bytes = static_cast<std::streamsize>(words_of(work) * sizeof(std::uint64_t));
    if (!in.read(reinterpret_cast<char*>(truth.bits.back().data()), bytes)) return std::nullopt;
    truth.seen.push_back(ones(truth.bits.back()));
  }
  return truth;
}

std::string bytes_of(const Truth& truth) {
  std::string bytes;
  for (const auto& frame : truth.bits)
    bytes.append(reinterpret_cast<const char*>(frame.data()), frame.size() * sizeof(std::uint64_t));
  return bytes;
}

}  // namespace

Truth kept_truth(const Workload& work, const std::filesystem::path& folder) {
  const auto file = folder / key_of(work);
  if (auto kept = read_truth(work, file)) return *std::move(kept);
  Truth truth = find_truth(work);
  files::make_folder(folder);
  files::write_whole(file, bytes_of(truth));
  return truth;
}

Truth find_truth(const Workload& work) {
  Truth truth;
  for (const culling::View& view : work.views) {
    truth.bits.push_back(seen_bits(view, work.city->boxes));
    truth.seen.push_back(ones(truth.bits.back()));
  }
  return truth;
}

std::vector<Counts> check(Peer& peer, const Workload& work, const Truth& truth) {
  std::vector<Counts> frames;
  Answer answer;
  std::vector<std::uint64_t> left;
  for (std::size_t frame = 0; frame < work.frusta.size(); ++frame) {
    const auto start = apps::Clock::now();
    peer.query(work.frusta[frame], answer);
    const double us = apps::us_since(start);
    left = truth.bits[frame];
    frames.push_back(compare(answer, peer, *work.city, left));
    frames.back().exact = truth.seen[frame];
    frames.back().query_us = us;
  }
  return frames;
}

Counts sum(const std::vector<Counts>& frames) {
  Counts all;
  for (const Counts& one : frames) {
    all.accepted += one.accepted;
    all.exact += one.exact;
    all.missed += one.missed;
    all.triangles += one.triangles;
    all.query_us += one.query_us;
  }
  return all;
}

std::vector<double> query_times(const std::vector<Counts>& frames) {
  std::vector<double> us;
  for (const Counts& one : frames) us.push_back(one.query_us);
  return us;
}

}  // namespace manzana::culling_benchmark
