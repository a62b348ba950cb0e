#include "foliage/import/ecosystem.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "foliage/import/folder_files.h"
#include "foliage/import/json_members.h"
#include "foliage/random.h"

namespace manzana::foliage {
namespace {

namespace fs = std::filesystem;

constexpr double kPi = 3.14159265358979323846;
constexpr std::uint64_t kMaxBytes = 64U << 20;    // of all files
constexpr std::size_t kMaxInstances = 1'000'000;  // of all files; scattered ones counted
constexpr double kFarthest = 1e6, kSmallest = 0.01, kLargest = 100;

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error(what); }

void check_range(const std::string& place, double value, double low, double high) {
  if (!(value >= low && value <= high)) fail_at(place, "is out of range");
}

Vec3d read_place(const Json& json, const std::string& place) {
  if (json.size() != 2 && json.size() != 3) fail_at(place, "is not two or three numbers");
  Vec3d out(0);
  for (std::size_t i = 0; i < json.size(); ++i) {
    double& value = out[static_cast<int>(i)];
    read_value(json[i], place, value);
    check_range(place, value, -kFarthest, kFarthest);
  }
  return out;
}

struct Scatter {
  int count = 0;
  double radius = 0;
  int seed = 1;
};

Scatter read_scatter(const Json& json, const std::string& place) {
  Scatter scatter;
  Members members(json, place);
  members.need("count", scatter.count).need("radius", scatter.radius).take("seed", scatter.seed);
  check_range(members.key("count"), scatter.count, 0, 1e6);
  check_range(members.key("radius"), scatter.radius, 0, kFarthest);
  members.finish();
  return scatter;
}

/// An instance whose child is still a name.
struct NamedInstance {
  std::string plant, ecosystem;
  std::vector<Placement> places;
};

void scatter_round(const Scatter& scatter, NamedInstance& instance) {
  const Placement middle = instance.places.at(0);
  instance.places.clear();
  Random random(hash(static_cast<std::uint64_t>(scatter.seed)));
  const auto uniform = [&] { return static_cast<double>(random.uniform()); };
  for (int i = 0; i < scatter.count; ++i) {
    const double r = scatter.radius * std::sqrt(uniform()), angle = 2 * kPi * uniform();
    const Vec3d offset(r * std::cos(angle), r * std::sin(angle), 0);
    instance.places.push_back({middle.position + offset, 2 * kPi * uniform(), middle.scale});
  }
}

NamedInstance read_instance(const Json& json, const std::string& place) {
  NamedInstance out;
  Placement at;
  double turn_deg = 0;
  Members members(json, place);
  members.take("plant", out.plant).take("ecosystem", out.ecosystem);
  if (out.plant.empty() == out.ecosystem.empty()) fail_at(place, "names neither a plant nor an ecosystem, or both");
  if (const Json* position = members.array("at")) at.position = read_place(*position, members.key("at"));
  members.take("turn", turn_deg).take("scale", at.scale);
  check_range(members.key("scale"), at.scale, kSmallest, kLargest);
  check_range(members.key("turn"), turn_deg, -360, 360);
  at.turn = turn_deg * kPi / 180;
  out.places = {at};
  if (const Json* scatter = members.find("scatter")) scatter_round(read_scatter(*scatter, members.key("scatter")), out);
  members.finish();
  return out;
}

/// `left`: how many places there may still be, of all files together.
std::vector<NamedInstance> read_instances(std::string_view text, std::size_t& left) {
  const Json root = parse_json(text);
  Members members(root, "");
  std::vector<NamedInstance> out;
  const Json* instances = members.array("instances");
  for (std::size_t i = 0; instances != nullptr && i < instances->size(); ++i) {
    const std::string place = "instances[" + std::to_string(i) + "]";
    out.push_back(read_instance((*instances)[i], place));
    if (out.back().places.size() > left) fail_at(place, "more than 1000000 instances in all files together");
    left -= out.back().places.size();
  }
  members.finish();
  return out;
}

class EcosystemReader {
 public:
  explicit EcosystemReader(const fs::path& folder) : files_(folder, kMaxBytes) {}

  /// Depth first, without recursion: a file is finished when all that it names are.
  Ecosystem run(const std::string& first) {
    begin(first);
    while (!open_.empty()) {
      Open& file = open_.back();
      if (file.next == file.instances.size()) {
        finish(file);
        open_.pop_back();
        continue;
      }
      const std::string& child = file.instances[file.next++].ecosystem;
      if (!child.empty() && !node_of_.contains(child)) begin(child);
    }
    return std::move(out_);
  }

 private:
  struct Open {
    std::string name;
    std::vector<NamedInstance> instances;
    std::size_t next = 0;
  };

  /// Where a message speaks of; of the first file its caller does.
  std::string in(const std::string& name) const { return open_.empty() || open_[0].name == name ? "" : name + ": "; }

  void begin(const std::string& name) {
    for (const Open& file : open_)
      if (file.name == name) fail(in(open_.back().name) + "refers to " + name + ", which leads back to it");
    if (open_.size() >= kMaxEcosystemDepth) fail(in(name) + "nested deeper than " + std::to_string(kMaxEcosystemDepth));
    const auto bytes = files_.read(name);
    if (!bytes) fail(in(name) + "no such file");
    try {
      open_.push_back({name, read_instances({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, left_), 0});
    } catch (const std::runtime_error& error) {
      fail(in(name) + error.what());
    }
  }

  std::uint32_t plant(const std::string& name) {
    const auto [found, added] = plant_of_.try_emplace(name, static_cast<std::uint32_t>(out_.plants.size()));
    if (!added) return found->second;
    const std::size_t hash_sign = name.rfind('#');
    const std::string file = name.substr(0, hash_sign);
    const auto full = files_.find(file);
    if (!full) fail("refers to the plant " + file + ", which is absent");
    out_.plants.push_back({*full, hash_sign == std::string::npos ? "" : name.substr(hash_sign + 1)});
    return found->second;
  }

  void finish(const Open& file) {
    EcosystemNode node{file.name, {static_cast<std::uint32_t>(out_.instances.size()), 0}, 0};
    for (const NamedInstance& named : file.instances) {
      const bool is_plant = named.ecosystem.empty();
      const std::uint32_t child = is_plant ? plant(named.plant) : node_of_.at(named.ecosystem);
      for (const Placement& at : named.places) out_.instances.push_back({is_plant, child, at});
      node.placed += named.places.size() * (is_plant ? 1 : 1 + out_.nodes[child].placed);
      if (node.placed > kMaxPlaced) fail(in(file.name) + "more than " + std::to_string(kMaxPlaced) + " plants in all");
    }
    node.instances.last = static_cast<std::uint32_t>(out_.instances.size());
    node_of_[file.name] = static_cast<std::uint32_t>(out_.nodes.size());
    out_.nodes.push_back(std::move(node));
  }

  FolderFiles files_;
  std::size_t left_ = kMaxInstances;
  std::vector<Open> open_;
  std::map<std::string, std::uint32_t> node_of_, plant_of_;
  Ecosystem out_;
};

/// Of balls, by their common box.
class BallUnion {
 public:
  void add(const Ball& ball) {
    if (ball.radius < 0) return;
    balls_.push_back(ball);
    low_ = glm::min(low_, ball.centre - ball.radius);
    high_ = glm::max(high_, ball.centre + ball.radius);
  }

  Ball ball() const {
    if (balls_.empty()) return {};
    Ball out{0.5 * (low_ + high_), 0};
    for (const Ball& b : balls_) out.radius = std::max(out.radius, glm::distance(out.centre, b.centre) + b.radius);
    return out;
  }

 private:
  std::vector<Ball> balls_;
  Vec3d low_{HUGE_VAL}, high_{-HUGE_VAL};
};

}  // namespace

Vec3d Placement::operator()(const Vec3d& p) const {
  const double c = std::cos(turn), s = std::sin(turn);
  return position + scale * Vec3d(c * p.x - s * p.y, s * p.x + c * p.y, p.z);
}

Placement Placement::operator()(const Placement& inner) const {
  return {(*this)(inner.position), turn + inner.turn, scale * inner.scale};
}

Ecosystem read_ecosystem(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  try {
    return EcosystemReader(folder).run(file.filename().string());
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  }
}

std::vector<Ball> node_balls(const Ecosystem& ecosystem, const std::vector<Ball>& plants) {
  std::vector<Ball> out;
  for (const EcosystemNode& node : ecosystem.nodes) {
    BallUnion all;
    for (std::uint32_t i = node.instances.first; i < node.instances.last; ++i) {
      const EcosystemInstance& instance = ecosystem.instances[i];
      const Ball& own = instance.is_plant ? plants[instance.child] : out[instance.child];
      if (own.radius >= 0) all.add({instance.at(own.centre), instance.at.scale * own.radius});
    }
    out.push_back(all.ball());
  }
  return out;
}

}  // namespace manzana::foliage
