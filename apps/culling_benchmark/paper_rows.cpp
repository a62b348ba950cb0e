#include "apps/culling_benchmark/paper_rows.h"

#include <algorithm>
#include <array>

#include "apps/common/statistics.h"
#include "apps/culling_benchmark/paper_record.h"
#include "apps/culling_benchmark/paper_values.h"

namespace manzana::paper {
namespace {

using apps::Column;

constexpr std::array kVams{"vam-block8", "vam-block6", "vam-block1"};

/// Over the measured frames of a part.
double part_sum(const LaneCosts& lane, Quantity quantity, int part, int parts) {
  double sum = 0;
  for (auto i = static_cast<std::size_t>(part); i < lane.frames.size(); i += static_cast<std::size_t>(parts))
    if (lane.frames[i].measured) sum += quantity(lane.frames[i]);
  return sum;
}

/// Lives for one call of paper_rows.
class RowMaker {
 public:
  explicit RowMaker(const PaperRun& run) : run_(run) {}

  struct Paper {
    std::optional<double> value, ratio;
  };
  struct Said {
    std::string table, row, quantity;
  };

  /// A row of a lane; nothing when it was not measured. Without a reference no ratio.
  void add(const Said& said, const LaneKey& key, Quantity quantity, const std::optional<LaneKey>& to,
           const std::string& ratio_to, const Paper& paper) {
    const LaneCosts* lane = find_lane(run_, key);
    const LaneCosts* reference = to ? find_lane(run_, *to) : nullptr;
    if (lane == nullptr || (to && reference == nullptr)) return;
    PaperRow row;
    row.paper_table = said.table, row.paper_row = said.row, row.quantity = said.quantity;
    row.case_name = key.city, row.peer = key.peer, row.cars = key.cars, row.car_levels = text_of(lane->lane.levels);
    row.residency = text_of(key.residency);
    row.attach = key.levels == 0 ? "" : text_of(key.attach);
    row.frames = static_cast<std::uint64_t>(
        std::count_if(lane->frames.begin(), lane->frames.end(), [](const FrameCost& f) { return f.measured; }));
    row.parts = static_cast<std::uint64_t>(run_.parts_done);
    row.dirty = dirty_parts(run_);
    row.value = mean(*lane, quantity);
    row.paper_value = paper.value, row.paper_ratio = paper.ratio;
    if (quantity == frame_ms) {
      row.query_ms = mean(*lane, query_ms), row.submit_ms = mean(*lane, submit_ms), row.draw_ms = mean(*lane, draw_ms);
    }
    if (reference != nullptr) set_ratio(row, *lane, *reference, quantity, ratio_to);
    rows.push_back(std::move(row));
  }

  std::vector<PaperRow> rows;

 private:
  void set_ratio(PaperRow& row, const LaneCosts& lane, const LaneCosts& reference, Quantity quantity,
                 const std::string& ratio_to) const {
    std::vector<double> ratios;
    for (int part = 0; part < run_.parts_done; ++part)
      ratios.push_back(part_sum(lane, quantity, part, run_.options.parts) /
                       part_sum(reference, quantity, part, run_.options.parts));
    const auto interval = apps::median_interval(ratios);
    row.ratio =
        quantity == triangle_count ? mean(lane, quantity) / mean(reference, quantity) : apps::median_ratio(ratios);
    row.ratio_to = ratio_to;
    row.reference = mean(reference, quantity);
    if (quantity != triangle_count) row.ratio_lo = interval.low, row.ratio_hi = interval.high;
  }

  const PaperRun& run_;
};

double ms(double seconds) { return 1000 * seconds; }

const PaperAverage* paper_average(const std::string& peer) {
  if (peer == "none") return &kPaperNone;
  if (peer.starts_with("vam")) return &kPaperVam;
  return peer == "bqr-paper" ? &kPaperBqr : nullptr;
}

void add_table_1(RowMaker& make) {
  for (const Residency way : {Residency::resent, Residency::resident}) {
    const std::string suffix = way == Residency::resent ? "" : ", all resident";
    for (const char* peer : {"none", "vam-block8", "vam-block6", "vam-block1", "bqr-paper", "bqr"}) {
      const PaperAverage* paper = way == Residency::resent ? paper_average(peer) : nullptr;
      RowMaker::Paper time, triangles;
      if (paper != nullptr) {
        time = {ms(paper->seconds), paper->seconds / kPaperNone.seconds};
        triangles = {paper->triangles, paper->triangles / kPaperNone.triangles};
      }
      const LaneKey key{"C2", peer, 0, 0, way}, none{"C2", "none", 0, 0, way};
      make.add({"1", title_of(peer) + suffix, "frame_ms"}, key, frame_ms, none, "no structure", time);
      if (way == Residency::resent)
        make.add({"1", title_of(peer), "triangles"}, key, triangle_count, none, "no structure", triangles);
    }
  }
  for (const char* vam : kVams) {
    const LaneKey key{"C2", "bqr-paper"}, to{"C2", vam};
    const std::string row = title_of("bqr-paper") + " over " + title_of(vam);
    make.add({"1", row, "frame_ms"}, key, frame_ms, to, title_of(vam), {{}, kPaperBqr.seconds / kPaperVam.seconds});
    make.add({"1", row, "triangles"}, key, triangle_count, to, title_of(vam),
             {{}, kPaperBqr.triangles / kPaperVam.triangles});
  }
}

void add_table_2(RowMaker& make) {
  for (const PaperCity& city : kPaperCities) {
    const std::string name(city.name);
    for (const char* vam : {"vam-block8", "vam-block6"}) {
      make.add({"2", name + ", " + title_of(vam), "frame_ms"}, {name, vam}, frame_ms, {}, "", {ms(city.vam_s), {}});
      for (const auto& [quantity, what] :
           {std::pair<Quantity, const char*>{frame_ms, "frame_ms"}, {triangle_count, "triangles"}})
        make.add({"2", name + ", " + title_of("bqr-paper"), what}, {name, "bqr-paper"}, quantity, LaneKey{name, vam},
                 title_of(vam),
                 quantity == frame_ms ? RowMaker::Paper{ms(city.bqr_s), city.bqr_s / city.vam_s} : RowMaker::Paper{});
    }
  }
}

void add_figure_8(RowMaker& make) {
  const LaneKey c1{"C1", "bqr-paper"};
  for (const PaperCity& city : kPaperCities) {
    const LaneKey key{std::string(city.name), "bqr-paper"};
    make.add({"8", key.city, "frame_ms"}, key, frame_ms, c1, "C1",
             {ms(city.bqr_s), city.bqr_s / kPaperCities[0].bqr_s});
    make.add({"8", key.city, "triangles"}, key, triangle_count, c1, "C1", {});
  }
}

std::string cars_text(std::uint32_t cars) { return std::to_string(cars) + " cars"; }

void add_table_3(RowMaker& make) {
  for (const PaperCars& paper : kPaperCars) {
    const LaneKey bqr{"C2", "bqr-paper", kFiveLevels.size(), paper.cars},
        vam{"C2", "vam-block8", kFiveLevels.size(), paper.cars};
    const LaneKey no_bqr{"C2", "bqr-paper", 1, 0}, no_vam{"C2", "vam-block8", 1, 0};
    const std::string row = cars_text(paper.cars) + " in levels of detail, ";
    make.add({"3", row + title_of(vam.peer), "frame_ms"}, vam, frame_ms, no_vam, "no cars",
             {ms(paper.vam_s), paper.vam_s / kPaperVam.seconds});
    make.add({"3", row + title_of(bqr.peer), "frame_ms"}, bqr, frame_ms, no_bqr, "no cars",
             {ms(paper.bqr_s), paper.bqr_s / kPaperBqr.seconds});
    make.add({"3", row + title_of(bqr.peer), "frame_ms"}, bqr, frame_ms, vam, title_of(vam.peer),
             {ms(paper.bqr_s), paper.bqr_s / paper.vam_s});
  }
}

void add_figure_9(RowMaker& make) {
  for (const std::uint32_t cars : {0U, 100U, 1'000U, 10'000U}) {
    const LaneKey bqr{"C2", "bqr-paper", 1, cars}, vam{"C2", "vam-block8", 1, cars};
    make.add({"9", cars_text(cars) + ", " + title_of(vam.peer), "frame_ms"}, vam, frame_ms, {}, "", {});
    make.add({"9", cars_text(cars) + ", " + title_of(bqr.peer), "frame_ms"}, bqr, frame_ms, vam, title_of(vam.peer),
             {});
  }
}

void add_text(RowMaker& make) {
  for (const std::uint32_t cars : {1'000U, 10'000U})
    for (const char* peer : {"vam-block8", "bqr-paper"}) {
      const LaneKey resent{"C2", peer, 1, cars};
      const std::string row = cars_text(cars) + ", " + title_of(peer);
      const auto add = [&](Residency way, const char* what, double paper) {
        LaneKey key = resent;
        key.residency = way;
        make.add({"text", row + ", " + what, "frame_ms"}, key, frame_ms, resent, "all re-sent", {{}, paper});
      };
      add(Residency::cars_resident, "cars resident", kPaperCarsResident);
      add(Residency::resident, "all resident", kPaperResident);
      LaneKey eager = resent;
      eager.attach = Attach::eager;
      make.add({"text", row + ", cars attached eagerly", "query_ms"}, eager, query_ms, resent, "lazily", {});
    }
}

constexpr std::array kColumns{
    apps::Column<PaperRow>{"paper_table", "", "table 1, 2 or 3, figure 8 or 9, or the text of section 4.2",
                           &PaperRow::paper_table},
    apps::Column<PaperRow>{"paper_row", "", "", &PaperRow::paper_row},
    apps::Column<PaperRow>{"quantity", "", "frame_ms: from the query to the return of glFinish", &PaperRow::quantity},
    apps::Column<PaperRow>{"case", "", "the city", &PaperRow::case_name},
    apps::Column<PaperRow>{"peer", "", "the structure", &PaperRow::peer},
    apps::Column<PaperRow>{"residency", "", "which geometry stays on the device", &PaperRow::residency},
    apps::Column<PaperRow>{"attach", "", "of cars to blocks", &PaperRow::attach},
    apps::Column<PaperRow>{"cars", "", "that drive", &PaperRow::cars},
    apps::Column<PaperRow>{"car_levels", "triangles", "of a car's levels", &PaperRow::car_levels},
    apps::Column<PaperRow>{"frames", "", "measured", &PaperRow::frames},
    apps::Column<PaperRow>{"parts", "", "of the flight; each gives a ratio", &PaperRow::parts},
    apps::Column<PaperRow>{"dirty", "", "parts during which other programs had the machine", &PaperRow::dirty},
    apps::Column<PaperRow>{"value", "quantity's", "mean over the frames", &PaperRow::value},
    apps::Column<PaperRow>{"ratio_to", "", "what the ratio's denominator is", &PaperRow::ratio_to},
    apps::Column<PaperRow>{"reference", "quantity's", "mean of that", &PaperRow::reference},
    apps::Column<PaperRow>{"ratio", "", "median over the parts; of triangles, of the means", &PaperRow::ratio},
    apps::Column<PaperRow>{"ratio_lo", "", "interval over the parts", &PaperRow::ratio_lo},
    apps::Column<PaperRow>{"ratio_hi", "", "", &PaperRow::ratio_hi},
    apps::Column<PaperRow>{"paper_value", "quantity's", "as printed; milliseconds of 2009", &PaperRow::paper_value},
    apps::Column<PaperRow>{"paper_ratio", "", "of the printed values", &PaperRow::paper_ratio},
    apps::Column<PaperRow>{"query_ms", "ms", "the structure's answer, and the cars of its blocks", &PaperRow::query_ms},
    apps::Column<PaperRow>{"submit_ms", "ms", "the GL calls, copies of geometry included", &PaperRow::submit_ms},
    apps::Column<PaperRow>{"draw_ms", "ms", "from the last GL call to the return of glFinish", &PaperRow::draw_ms},
};

}  // namespace

std::string title_of(const std::string& peer) {
  if (peer == "none") return "no structure";
  if (peer == "bqr") return "BqR-Tree, objects";
  if (peer == "bqr-paper") return "BqR-Tree, whole blocks";
  if (peer == "vam-block1") return "VAMSplit, 1 block a page";
  return "VAMSplit, " + peer.substr(peer.size() - 1) + " blocks a page";
}

std::span<const apps::Column<PaperRow>> paper_columns() { return kColumns; }

std::string to_csv(std::span<const PaperRow> rows) {
  std::string text = apps::head_line(paper_columns());
  for (const PaperRow& row : rows) text += apps::to_line(row, paper_columns());
  return text;
}

const LaneCosts* find_lane(const PaperRun& run, const LaneKey& key) {
  const auto found = std::find_if(run.lanes.begin(), run.lanes.end(), [&](const LaneCosts& costs) {
    const Lane& lane = costs.lane;
    return lane.city == key.city && lane.levels.size() == key.levels && lane.cars == key.cars &&
           lane.peer == key.peer && lane.residency == key.residency && lane.attach == key.attach;
  });
  return found == run.lanes.end() ? nullptr : &*found;
}

std::uint64_t city_triangles(const PaperRun& run, const std::string& city) {
  const auto found =
      std::find_if(run.lanes.begin(), run.lanes.end(), [&](const LaneCosts& l) { return l.lane.city == city; });
  return found == run.lanes.end() ? 0 : found->city_triangles;
}

std::size_t dirty_parts(const PaperRun& run) {
  std::size_t dirty = 0;
  for (std::size_t part = 0; !run.lanes.empty() && part < static_cast<std::size_t>(run.parts_done); ++part)
    dirty += run.lanes[0].frames[part].dirty ? 1 : 0;
  return dirty;
}

double mean(const LaneCosts& lane, Quantity quantity) {
  double sum = 0, frames = 0;
  for (const FrameCost& frame : lane.frames) {
    if (!frame.measured) continue;
    sum += quantity(frame);
    ++frames;
  }
  return sum / frames;
}

std::vector<PaperRow> paper_rows(const PaperRun& run) {
  RowMaker make(run);
  add_table_1(make);
  add_table_2(make);
  add_table_3(make);
  add_figure_8(make);
  add_figure_9(make);
  add_text(make);
  return std::move(make.rows);
}

}  // namespace manzana::paper
