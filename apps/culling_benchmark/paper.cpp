#include "apps/culling_benchmark/paper.h"

#include <algorithm>
#include <chrono>
#include <numeric>

#include "apps/culling_benchmark/paper_job.h"
#include "culling/hash.h"
#include "gl/context.h"

namespace manzana::paper {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

bool available(const std::string& peer) {
  const auto* info = baselines::find_peer(peer);
  return info != nullptr && info->available;
}

std::vector<Lane> lanes(std::initializer_list<const char*> peers, std::initializer_list<Residency> ways) {
  std::vector<Lane> all;
  for (const Residency way : ways)
    for (const char* peer : peers)
      if (available(peer)) all.push_back({peer, way, Attach::lazy});
  return all;
}

/// Lane numbers in an order that is the frame's own.
std::vector<std::size_t> shuffled(std::size_t lanes, std::uint64_t seed, int frame) {
  std::vector<std::size_t> order(lanes);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::uint64_t own = hash_bits(seed, static_cast<std::uint64_t>(frame));
  std::sort(order.begin(), order.end(),
            [own](std::size_t a, std::size_t b) { return hash_bits(own, a) < hash_bits(own, b); });
  return order;
}

/// Shaders are compiled, the stream grows to what the whole city takes, and its pages are touched.
void warm_up(ReadyJob& ready, std::size_t lanes, int frames) {
  for (const int frame : {0, frames / 3, frames - 1})
    for (std::size_t lane = 0; lane < lanes; ++lane) ready.frame(lane, frame);
}

void run_part(JobCosts& costs, const PaperOptions& options, int part, Stage& stage,
              const std::function<void(double)>& progress) {
  ReadyJob ready(costs.job, options, stage);
  const baselines::City& city = ready.city();
  costs.triangles = std::accumulate(city.triangles.begin(), city.triangles.end(), std::uint64_t{0});
  warm_up(ready, costs.lanes.size(), options.frames);
  for (int frame = part; frame < options.frames; frame += options.parts) {
    progress(static_cast<double>(frame) / options.frames);
    for (const std::size_t lane : shuffled(costs.lanes.size(), options.seed, frame))
      costs.lanes[lane].frames[static_cast<std::size_t>(frame)] = ready.frame(lane, frame);
  }
}

JobCosts empty_costs(const Job& job, int frames) {
  JobCosts costs{job, 0, {}};
  for (const Lane& lane : job.lanes)
    costs.lanes.push_back({lane, std::vector<FrameCost>(static_cast<std::size_t>(frames))});
  return costs;
}

}  // namespace

std::vector<Job> paper_jobs() {
  using enum Residency;
  std::vector<Job> jobs;
  jobs.push_back(
      {"C2", {}, 0, lanes({"none", "vam-block8", "vam-block6", "vam-block1", "bqr-paper", "bqr"}, {resent, resident})});
  for (const char* city : {"C1", "C3", "C4", "C5", "C6"})
    jobs.push_back({city, {}, 0, lanes({"vam-block8", "vam-block6", "bqr-paper"}, {resent})});
  for (const std::uint32_t cars : {0U, 100U})
    jobs.push_back({"C2", kOneLevel, cars, lanes({"vam-block8", "bqr-paper"}, {resent})});
  for (const std::uint32_t cars : {1'000U, 10'000U}) {
    jobs.push_back({"C2", kOneLevel, cars, lanes({"vam-block8", "bqr-paper"}, {resent, cars_resident, resident})});
    if (available("bqr-paper")) jobs.back().lanes.push_back({"bqr-paper", resent, Attach::eager});
    jobs.push_back({"C2", kFiveLevels, cars, lanes({"vam-block8", "bqr-paper"}, {resent})});
  }
  return jobs;
}

PaperRun run_paper(const PaperOptions& options, const Progress& progress) {
  return run_jobs(paper_jobs(), options, progress);
}

PaperRun run_jobs(std::vector<Job> jobs, const PaperOptions& options, const Progress& progress) {
  PaperRun run{options, gl::renderer_name(), 0, {}};
  for (const Job& job : jobs) run.jobs.push_back(empty_costs(job, options.frames));
  Stage stage(options.width, options.height);
  const auto begin = Clock::now();
  const auto steps = static_cast<double>(jobs.size()) * options.parts;
  double longest_s = 0, step = 0;
  for (; run.parts_done < options.parts; ++run.parts_done) {
    const double before_s = seconds_since(begin);
    if (run.parts_done > 0 && before_s + longest_s > options.budget_s) break;
    for (JobCosts& costs : run.jobs) {
      run_part(costs, options, run.parts_done, stage,
               [&](double done) { progress("Pina 2009, " + costs.job.city, (step + done) / steps); });
      ++step;
    }
    longest_s = std::max(longest_s, seconds_since(begin) - before_s);
  }
  return run;
}

}  // namespace manzana::paper
