// What choosing and extracting costs, all trees at once or node after node, against a copy of as many bytes.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "apps/common/markdown.h"
#include "apps/foliage_benchmark/forest.h"
#include "apps/foliage_benchmark/times.h"
#include "apps/foliage_benchmark/times_md.h"
#include "foliage_benchmark_parts_shaders.h"
#include "gl/program.h"
#include "scenegraph/draw/tree_layer.h"

namespace manzana::foliage_benchmark {
namespace {

using foliage::PreparedPlant;

constexpr const char* kExtraction = "extraction";
constexpr std::uint32_t kNode = 20;  // trees of a visible node: those of a block of the built-in town
constexpr double kSpacing = 20;      // metres

struct Traffic {
  std::uint64_t read = 0, written = 0;
};

/// Trees that are all in view, and nothing drawn.
class Rig {
 public:
  Rig(std::span<const PreparedPlant> plants, std::uint32_t trees, double spacing_m)
      : trees_(trees),
        store_(plants),
        extractor_(make_forest(plants, trees, spacing_m, 3), {.lines = 1U << 19, .points = 1U << 22}),
        rows_(gl::make_buffer(sizeof(draw::Rows))) {
    foliage::set_details(store_, make_details(plants, foliage::Law::ours));
    for (std::uint32_t first = 0; first < trees; first += kNode)
      nodes_.push_back({first, std::min(trees, first + kNode)});
    std::vector<std::uint32_t> sites(trees);
    std::iota(sites.begin(), sites.end(), 0);
    sites_in_view_ = gl::make_buffer(std::as_bytes(std::span(sites)));
    const double half = spacing_m * std::sqrt(trees) / 2, high = static_cast<double>(plants.front().height_m);
    const auto rows = rows_seen_from({-1.1 * half, 0, 2 * high});
    glNamedBufferSubData(rows_.name(), 0, sizeof rows, rows.data());
    view_ = {sites_in_view_.name(), 0, trees, 1.0 / 623};
  }

  void extract_at_once() {
    bind();
    extract(extractor_, store_, view_);
    glFinish();
  }
  void extract_nodes() {
    bind();
    extract_by_node(extractor_, store_, view_, nodes_);
    glFinish();
  }

  foliage::Shown shown() { return newest_shown(extractor_); }
  Traffic traffic() const;
  std::vector<std::string> memory() const;  ///< bytes

 private:
  void bind() { glBindBufferBase(GL_SHADER_STORAGE_BUFFER, foliage::kBlockRowsBinding, rows_.name()); }
  foliage::glsl::Totals totals() const {
    foliage::glsl::Totals totals;
    glGetNamedBufferSubData(extractor_.totals.name(), 0, sizeof totals, &totals);
    return totals;
  }

  std::uint32_t trees_;
  foliage::PlantStore store_;
  foliage::Extractor extractor_;
  gl::Buffer rows_, sites_in_view_;
  std::vector<foliage::Run> nodes_;
  foliage::TreesInView view_;
};

/// Each word that an invocation of foliage/shaders/*.comp loads or stores, once a pass; not what the search for a
/// cell's tree and the scan of blocks' sums read.
Traffic Rig::traffic() const {
  constexpr std::uint64_t kWord = sizeof(GLuint), kRecord = sizeof(foliage::TreeRecord) / kWord;
  constexpr std::uint64_t kItem = sizeof(foliage::Item) / kWord, kRows = sizeof(draw::Rows) / kWord;
  constexpr std::uint64_t kSite = 11, kHead = 22, kTwoDetails = 2 * 8;                   // place: what it uses of them
  constexpr std::uint64_t kCell = 5 + 1 + 2, kTwoDetailsOfCell = 2 * (4 + 1);            // choose: with the tree's
  constexpr std::uint64_t kCounts = foliage::glsl::kFixedItems, kSums = 4, kBlocks = 4;  // of a tree; of a cell 1 each
  const foliage::glsl::Totals all = totals();
  const std::uint64_t groups = std::uint64_t{all.groups.x} + all.groups.y + all.groups.z;
  Traffic words;
  words.read = trees_ * ((1 + kSite + kRows + kHead + kTwoDetails) + (kCounts + 1) + (kCounts + kSums + kBlocks)) +
               all.cells * ((kRecord + kCell + kTwoDetailsOfCell) + 1 + 3);
  words.written = trees_ * ((kRecord + kCounts * kItem + kCounts + 1) + kSums) + all.cells * (kItem + 1) + groups * 2;
  return {words.read * kWord, words.written * kWord};
}

std::uint64_t size_of(const gl::Buffer& buffer) {
  GLint64 bytes = 0;
  glGetNamedBufferParameteri64v(buffer.name(), GL_BUFFER_SIZE, &bytes);
  return static_cast<std::uint64_t>(bytes);
}

template <class... B>
std::string size_of_all(const B&... buffers) {
  return apps::grouped(static_cast<double>((size_of(buffers) + ...)));
}

std::vector<std::string> Rig::memory() const {
  const auto& s = store_;
  const auto& e = extractor_;
  const Traffic bytes = traffic();
  return {apps::grouped(trees_),
          size_of_all(s.plants, s.cells, s.steps, s.details, s.views, s.quads, s.lines, s.points),
          size_of_all(e.sites, sites_in_view_),
          size_of_all(e.trees, e.counts, e.tree_sums.offsets, e.tree_sums.blocks),
          size_of_all(e.items, e.cell_sums.offsets, e.cell_sums.blocks),
          size_of_all(e.groups, e.commands),
          apps::grouped(static_cast<double>(bytes.read)),
          apps::grouped(static_cast<double>(bytes.written))};
}

/// Reads and writes so many bytes.
class Copy {
 public:
  explicit Copy(const Traffic& bytes)
      : reads_(static_cast<std::uint32_t>(bytes.read / sizeof(glm::uvec4))),
        writes_(static_cast<std::uint32_t>(bytes.written / sizeof(glm::uvec4))),
        from_(gl::make_buffer(bytes.read)),
        to_(gl::make_buffer(bytes.written)),
        program_(gl::make_compute_program("copy", {"#version 450 core\n", shaders::copy_comp})) {}
  void run() {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, from_.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, to_.name());
    glUseProgram(program_.name());
    glUniform1ui(0, reads_);
    glUniform1ui(1, writes_);
    glDispatchCompute((std::max(reads_, writes_) + 63) / 64, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    glFinish();
  }

 private:
  std::uint32_t reads_, writes_;
  gl::Buffer from_, to_;
  gl::Program program_;
};

TimeRow key_of(std::size_t species, std::uint32_t trees, const char* reference) {
  TimeRow row{.table = kExtraction, .plant = std::to_string(species) + " species", .reference = reference};
  row.way = apps::grouped(trees) + (trees == 1 ? " tree" : " trees") + " at once";
  row.trees = trees;
  return row;
}

void time_copy(const Effort& effort, Rig& rig, TimeRow& row) {
  rig.extract_at_once();
  if (rig.shown().missing > 0) throw std::runtime_error("the lists have no room for the forest");
  set_shown(rig.shown(), row);
  Copy copy(rig.traffic());
  set_times(time_pairs([&] { rig.extract_at_once(); }, [&] { copy.run(); }, effort.seconds(), row.trees), row);
}

void time_nodes(const Effort& effort, Rig& rig, TimeRow& row) {
  set_times(time_pairs([&] { rig.extract_at_once(); }, [&] { rig.extract_nodes(); }, effort.seconds(), row.trees), row);
}

}  // namespace

void add_extraction(const Effort& effort, std::span<const PreparedPlant> plants, Times& times) {
  const auto species = plants.first(std::min<std::size_t>(plants.size(), 7));
  std::vector<std::vector<std::string>> memory{
      {"trees", "plants", "sites", "records", "items", "groups", "read", "written"}};
  for (const std::uint32_t trees : {4000U, 100'000U}) {
    Lazy<Rig> rig([&] { return Rig(species, trees, kSpacing); });
    times.add(key_of(species.size(), trees, "copy of as many bytes"),
              [&](TimeRow& row) { time_copy(effort, *rig, row); });
    times.draw([&] {
      rig->extract_at_once();
      memory.push_back(rig->memory());
    });
  }
  for (const std::uint32_t trees : {1U, 100U, 10'000U}) {
    times.add(key_of(species.size(), trees, "node after node"), [&](TimeRow& row) {
      Rig rig(species, trees, kSpacing);
      time_nodes(effort, rig, row);
    });
  }
  times.text +=
      "## Extraction\n\nChoosing what is shown of trees that are all in view, a pixel tolerated, and writing it to "
      "lists: "
      "all at once, against a shader that only copies as many bytes as the passes read and write (meant: at least 0.5 "
      "times as fast), and against nodes of " +
      std::to_string(kNode) + " trees one after the other.\n\n" + rows_md(times.rows, kExtraction) +
      "\nBytes on the GPU, items and groups as room for whatever is in view; and those that the passes read and "
      "write.\n\n" +
      apps::md_table(memory) + "\n";
}

}  // namespace manzana::foliage_benchmark
