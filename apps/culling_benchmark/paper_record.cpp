#include "apps/culling_benchmark/paper_record.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

namespace manzana::paper {
namespace {

using apps::Column;

constexpr std::array kColumns{
    apps::Column<FrameRow>{"made_by", "", "commit and machine", &FrameRow::made_by},
    apps::Column<FrameRow>{"renderer", "", "of the GL", &FrameRow::renderer},
    apps::Column<FrameRow>{"seed", "", "of the city, its cars, and the order of measurement", &FrameRow::seed},
    apps::Column<FrameRow>{"frames", "", "of the flight", &FrameRow::frames},
    apps::Column<FrameRow>{"parts", "", "of it; frame i is of part i modulo parts", &FrameRow::parts},
    apps::Column<FrameRow>{"width", "pixels", "", &FrameRow::width},
    apps::Column<FrameRow>{"height", "pixels", "", &FrameRow::height},
    apps::Column<FrameRow>{"case", "", "the city", &FrameRow::case_name},
    apps::Column<FrameRow>{"peer", "", "the structure", &FrameRow::peer},
    apps::Column<FrameRow>{"residency", "", "which geometry stays on the device", &FrameRow::residency},
    apps::Column<FrameRow>{"attach", "", "when cars are attached to blocks", &FrameRow::attach},
    apps::Column<FrameRow>{"car_levels", "triangles", "of the levels of a car", &FrameRow::car_levels},
    apps::Column<FrameRow>{"cars", "", "that drive", &FrameRow::cars},
    apps::Column<FrameRow>{"city_triangles", "", "of all of the city", &FrameRow::city_triangles},
    apps::Column<FrameRow>{"frame", "", "of the flight, from 0", &FrameRow::frame},
    apps::Column<FrameRow>{"query_ms", "ms", "the structure's answer, and the cars of its blocks", &FrameRow::query_ms},
    apps::Column<FrameRow>{"submit_ms", "ms", "the GL calls, copies of geometry included", &FrameRow::submit_ms},
    apps::Column<FrameRow>{"draw_ms", "ms", "from the last GL call to the return of glFinish", &FrameRow::draw_ms},
    apps::Column<FrameRow>{"triangles", "", "submitted", &FrameRow::triangles},
    apps::Column<FrameRow>{"dirty", "", "1: other programs had the machine meanwhile", &FrameRow::dirty},
};

FrameRow row_of(const PaperRun& run, const LaneCosts& costs, std::size_t frame, const std::string& made_by) {
  const PaperOptions& o = run.options;
  const Lane& lane = costs.lane;
  const FrameCost& cost = costs.frames[frame];
  return {made_by,
          run.renderer,
          o.seed,
          static_cast<std::uint64_t>(o.frames),
          static_cast<std::uint64_t>(o.parts),
          static_cast<std::uint64_t>(o.width),
          static_cast<std::uint64_t>(o.height),
          lane.city,
          lane.peer,
          text_of(lane.residency),
          lane.levels.empty() ? "" : text_of(lane.attach),
          text_of(lane.levels),
          lane.cars,
          costs.city_triangles,
          frame,
          cost.query_ms,
          cost.submit_ms,
          cost.draw_ms,
          cost.triangles,
          std::uint64_t{cost.dirty}};
}

/// All that tells one measurement from another.
auto key(const FrameRow& r) {
  return std::tie(r.made_by, r.renderer, r.seed, r.frames, r.parts, r.width, r.height, r.case_name, r.peer, r.residency,
                  r.attach, r.car_levels, r.cars, r.frame);
}
struct Earlier {
  bool operator()(const FrameRow& a, const FrameRow& b) const { return key(a) < key(b); }
};

bool part_is_whole(const PaperRun& run, int part) {
  for (const LaneCosts& lane : run.lanes)
    for (auto i = static_cast<std::size_t>(part); i < lane.frames.size();
         i += static_cast<std::size_t>(run.options.parts))
      if (!lane.frames[i].measured) return false;
  return true;
}

}  // namespace

std::span<const apps::Column<FrameRow>> frame_columns() { return kColumns; }

std::string text_of(Residency residency) {
  constexpr std::array kTexts{"re-sent", "cars resident", "resident"};
  return kTexts.at(static_cast<std::size_t>(residency));
}

std::string text_of(Attach attach) { return attach == Attach::lazy ? "lazy" : "eager"; }

std::string text_of(std::span<const CarLevel> levels) {
  std::string text;
  for (const CarLevel& level : levels) {
    if (!text.empty()) text += ' ';
    text += std::to_string(level.triangles);
  }
  return text;
}

std::string record(const PaperRun& run, const std::string& made_by) {
  std::string text = apps::head_line(frame_columns());
  for (const LaneCosts& lane : run.lanes)
    for (std::size_t i = 0; i < lane.frames.size(); ++i)
      if (lane.frames[i].measured) text += apps::to_line(row_of(run, lane, i, made_by), frame_columns());
  return text;
}

void restore(PaperRun& run, std::string_view text, const std::string& made_by) {
  std::map<FrameRow, FrameCost, Earlier> known;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (const auto row = apps::from_line(text.substr(at, end - at), frame_columns())) {
      if (run.renderer.empty() && row->made_by == made_by) run.renderer = row->renderer;
      known[*row] = {true, row->query_ms, row->submit_ms, row->draw_ms, row->triangles, row->dirty != 0};
    }
    at = end + 1;
  }
  for (LaneCosts& lane : run.lanes)
    for (std::size_t i = 0; i < lane.frames.size(); ++i) {
      const auto found = known.find(row_of(run, lane, i, made_by));
      if (found != known.end()) lane.frames[i] = found->second, lane.city_triangles = found->first.city_triangles;
    }
  while (run.parts_done < run.options.parts && part_is_whole(run, run.parts_done)) ++run.parts_done;
}

}  // namespace manzana::paper
