#include "apps/foliage_benchmark/forest_errors.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "apps/common/child.h"
#include "apps/common/markdown.h"
#include "apps/foliage_benchmark/sheet.h"
#include "culling/hash.h"

namespace manzana::foliage_benchmark {
namespace {

using foliage::Law;

/// Of a picture that is compared with all detail, finely sampled.
struct Kind {
  Law law;
  Sampling sampling;
  const char* name;
};
constexpr Kind kMoved{Law::full, Sampling::fine, "moved"};
constexpr std::array<Kind, 3> kKinds{{{Law::full, Sampling::product, "product"},
                                      {Law::ours, Sampling::fine, "fine"},
                                      {Law::ours, Sampling::product, "product"}}};
constexpr std::size_t kRows = kKinds.size() + 1;  // of a frame

constexpr double kLeastCovered = 0.1;  // of a window
constexpr int kGap = 12;               // wider than what structure is judged with

/// In half pixels, with one pixel more to the right: of it the picture is made, and the picture half a pixel beside.
Shot in_halves(const Shot& window) {
  Shot halves = window;
  halves.width = 2 * (window.width + 1);
  halves.height = 2 * window.height;
  halves.focal_px = 2 * window.focal_px;
  halves.view.tan_right += 1 / window.focal_px;
  halves.fine = window.fine / 2;
  return halves;
}

Picture in_pixels(const Picture& halves, int right) {
  Picture picture = make_picture(halves.width / 2 - 1, halves.height / 2);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}})
        picture.at(x, y) += 0.25F * halves.at(2 * x + right + i, 2 * y + j);
  return picture;
}

foliage::Shown operator+(const foliage::Shown& a, const foliage::Shown& b) {
  return {a.bark + b.bark, a.leaves + b.leaves, a.lines + b.lines, a.points + b.points, a.missing + b.missing};
}

class FrameErrors {
 public:
  FrameErrors(Ground& ground, const ForestErrorPlan& plan, std::string name, std::vector<Shot> windows)
      : ground_(ground), plan_(plan), name_(std::move(name)), windows_(std::move(windows)) {}

  std::vector<ErrorRow> measure() {
    std::vector<Picture> references, moved;
    Drawn drawn;
    for (const Shot& window : windows_) {
      const Picture halves = all_detail(in_halves(window), Sampling::fine, drawn);
      references.push_back(in_pixels(halves, 0));
      moved.push_back(in_pixels(halves, 1));
    }
    reference_ = beside(references, kGap);
    sheet_ = {words(name_ + ": all detail, " + std::to_string(plan_.fine * plan_.fine) + " samples"), reference_};
    drawn.picture = beside(moved, kGap);
    std::vector<ErrorRow> rows{compare(kMoved, drawn)};
    for (const Kind& kind : kKinds) rows.push_back(compare(kind, draw(kind)));
    return rows;
  }
  Picture sheet() const { return below(sheet_); }

 private:
  struct Drawn {
    Picture picture;
    foliage::Shown shown;
    std::uint64_t far = 0;
  };

  Picture all_detail(const Shot& window, Sampling sampling, Drawn& drawn) {
    apps::throw_if_interrupted();
    ground_.stage().set_law(Law::full);
    Picture picture = ground_.stage().draw(ground_.in_view(window), window, {.sampling = sampling});
    drawn.shown = drawn.shown + ground_.stage().shown();
    return picture;
  }

  Picture ours(const Shot& window, Sampling sampling, Drawn& drawn) {
    Picture picture = ground_.draw(window, plan_.exactness, sampling);
    drawn.shown = drawn.shown + ground_.stage().shown();
    if (ground_.far() != nullptr) drawn.far += primitives_of(*ground_.far());
    return picture;
  }

  Drawn draw(const Kind& kind) {
    Drawn drawn;
    std::vector<Picture> pictures;
    for (const Shot& window : windows_)
      pictures.push_back(kind.law == Law::full ? all_detail(window, kind.sampling, drawn)
                                               : ours(window, kind.sampling, drawn));
    drawn.picture = beside(pictures, kGap);
    return drawn;
  }

  ErrorRow compare(const Kind& kind, const Drawn& drawn) {
    if (drawn.shown.missing > 0) throw std::runtime_error("lists have no room for what a window of the forest shows");
    ErrorRow row;
    static_cast<apps::RunFacts&>(row) = apps::run_facts(plan_.mode);
    row.plant = name_;
    row.law = name_of(kind.law);
    row.sampling = kind.name;
    row.error_px = kind.law == Law::full ? 0 : plan_.exactness.error_px;
    set_counts(drawn.shown, row);
    row.primitives += drawn.far;
    set_errors(image_error(reference_, drawn.picture), row);
    sheet_.push_back(words(row.law + ", " + row.sampling + ": cover " + apps::digits3(row.cover) + ", colour " +
                           apps::digits3(row.colour) + ", SSIM " + apps::digits3(row.ssim) + ", GMSD " +
                           apps::digits3(row.gmsd)));
    sheet_.push_back(drawn.picture);
    return row;
  }

  Ground& ground_;
  const ForestErrorPlan& plan_;
  std::string name_;
  std::vector<Shot> windows_;
  Picture reference_;
  std::vector<Picture> sheet_;
};

}  // namespace

std::vector<Shot> windows_of(Ground& ground, const Shot& frame, std::uint64_t number, const ForestErrorPlan& plan) {
  const Picture whole = ground.draw(frame, plan.exactness, Sampling::product);
  const int width = frame.width / plan.columns, height = frame.height / plan.rows;
  std::vector<int> cells(static_cast<std::size_t>(plan.columns * plan.rows));
  std::iota(cells.begin(), cells.end(), 0);
  const auto by_chance = [&](int cell) {
    return hash_bits(plan.seed, number * cells.size() + static_cast<std::uint64_t>(cell));
  };
  std::ranges::sort(cells, {}, by_chance);
  std::vector<Shot> windows;
  for (const int cell : cells) {
    if (static_cast<int>(windows.size()) == plan.windows) break;
    const int left = cell % plan.columns * width, low = cell / plan.columns * height;
    const Picture part = cropped(whole, {left, low, left + width, low + height});
    if (static_cast<double>(covered(part)) < kLeastCovered * width * height) continue;
    windows.push_back(window_of(frame, left, low, width, height));
    windows.back().fine = plan.fine;
  }
  return windows;
}

std::vector<ErrorRow> measure_forest_errors(Ground& ground, std::span<const Shot> path, const ForestErrorPlan& plan,
                                            const std::function<void(double)>& progress, apps::Record<ErrorRow>& record,
                                            const std::function<void(const std::string&, const Picture&)>& show) {
  std::vector<ErrorRow> rows;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const std::string name = "frame_" + std::to_string(i);
    std::vector<ErrorRow> of_frame;
    for (const ErrorRow& row : record.rows())
      if (row.plant == name) of_frame.push_back(row);
    if (of_frame.size() != kRows) {
      record.drop([&](const ErrorRow& row) { return row.plant == name; });
      FrameErrors frame(ground, plan, name, windows_of(ground, path[i], i, plan));
      of_frame = frame.measure();
      for (const ErrorRow& row : of_frame) record.keep(row);
      show(name, frame.sheet());
    }
    rows.insert(rows.end(), of_frame.begin(), of_frame.end());
    progress(static_cast<double>(i + 1) / static_cast<double>(path.size()));
  }
  return rows;
}

namespace {

std::string count_md(std::span<const Verdict> verdicts, std::string_view sampling) {
  std::size_t all = 0, under = 0, covers = 0;
  for (const Verdict& v : verdicts) {
    if (v.law == name_of(Law::full) || v.sampling != sampling) continue;
    ++all;
    under += v.over.empty() ? 1 : 0;
    covers += v.over.find("cover") == std::string::npos ? 1 : 0;
  }
  return std::to_string(under) + " of " + std::to_string(all) + " frames are under every floor, " +
         std::to_string(covers) + " cover within 2 %";
}

}  // namespace

std::string forest_errors_md(std::span<const Verdict> verdicts, const ForestErrorPlan& plan) {
  using apps::digits3;
  std::vector<std::vector<std::string>> cells{
      {"frame", "law", "sampling", "primitives", "cover", "colour", "SSIM (floor)", "GMSD (floor)", "over the floor"}};
  for (const Verdict& v : verdicts)
    cells.push_back({v.plant, v.law, v.sampling, apps::grouped(static_cast<double>(v.primitives)), digits3(v.cover),
                     digits3(v.colour), digits3(v.ssim) + " (" + digits3(v.floor_ssim) + ")",
                     digits3(v.gmsd) + " (" + digits3(v.floor_gmsd) + ")", v.over.empty() ? "under" : v.over});
  return "Errors: " + std::to_string(plan.windows) + " windows of each frame, of " +
         std::to_string(plan.columns * plan.rows) + " chosen by chance, side by side, against all detail with " +
         std::to_string(plan.fine * plan.fine) +
         " samples a pixel. Floors are all detail moved by half a pixel, and with 4 samples a pixel.\n\n- By the model "
         "alone, sampled as finely: " +
         count_md(verdicts, "fine") + ".\n- As the product samples: " + count_md(verdicts, "product") + ".\n\n" +
         apps::md_table(cells);
}

}  // namespace manzana::foliage_benchmark
