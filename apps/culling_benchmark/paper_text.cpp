#include "apps/culling_benchmark/paper_text.h"

#include <algorithm>

#include "apps/common/markdown.h"
#include "apps/culling_benchmark/paper_values.h"
#include "gl/context.h"

namespace manzana::paper {
namespace {

using apps::digits3;
using apps::grouped;
using Rows = std::vector<std::vector<std::string>>;

std::string cell(const std::optional<double>& value) { return value ? apps::digits3(*value) : ""; }

std::string interval(const PaperRow& row) {
  if (!row.ratio) return "";
  return apps::digits3(*row.ratio) + (row.ratio_lo && row.parts > 1 ? " [" + apps::digits3(*row.ratio_lo) + ", " +
                                                                          apps::digits3(*row.ratio_hi) + "]"
                                                                    : "");
}

std::string value(const PaperRow& row, double of) {
  return row.quantity == "triangles" ? apps::grouped(of) : apps::digits3(of);
}

std::vector<std::string> cells(const PaperRow& row, bool parts) {
  std::vector<std::string> line{row.paper_row, value(row, row.value)};
  if (parts) line.insert(line.end(), {cell(row.query_ms), cell(row.submit_ms), cell(row.draw_ms)});
  line.insert(line.end(), {row.ratio_to, interval(row), row.paper_value ? value(row, *row.paper_value) : "",
                           cell(row.paper_ratio)});
  return line;
}

/// The rows of one table and quantity; empty without any.
std::string table(std::span<const PaperRow> rows, const std::string& which, const std::string& quantity,
                  const std::string& unit) {
  const bool parts = quantity == "frame_ms";
  Rows lines{{"", "ours, " + unit}};
  if (parts) lines[0].insert(lines[0].end(), {"query", "submission", "drawing"});
  lines[0].insert(lines[0].end(), {"over", "our ratio", "paper, " + unit, "paper's ratio"});
  for (const PaperRow& row : rows)
    if (row.paper_table == which && row.quantity == quantity) lines.push_back(cells(row, parts));
  return lines.size() > 1 ? apps::md_table(lines) : "";
}

/// One of the rows, by what it is of.
const PaperRow* find_row(std::span<const PaperRow> rows, const std::string& which, const std::string& name,
                         const std::string& quantity, const std::string& ratio_to) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const PaperRow& row) {
    return row.paper_table == which && row.paper_row == name && row.quantity == quantity && row.ratio_to == ratio_to;
  });
  return found == rows.end() ? nullptr : &*found;
}

double over(std::uint64_t a, std::uint64_t b) { return static_cast<double>(a) / static_cast<double>(b); }

std::string head_text(const PaperRun& run) {
  const PaperOptions& o = run.options;
  std::string text =
      "## Pina 2009\n"
      "The experiments of its section 4 on generated cities (its own is not public): the flight of figure 4 in " +
      std::to_string(o.frames) + " frames, dealt into " + std::to_string(o.parts) + " parts, of which " +
      std::to_string(run.parts_done) + " were measured" +
      (run.parts_done < o.parts ? " in the time there was (the same command measures the rest)" : "") +
      "; in each part all structures draw a frame one after the other, "
      "in an order that chance decides. Drawn by **" +
      run.renderer + "** at " + std::to_string(o.width) + " x " + std::to_string(o.height) +
      ", no faces culled, as in the paper, whose card was a GeForce 6800 Ultra: of its times only the ratios can "
      "agree. "
      "Times are means over the frames, ratios medians over the parts with their interval; triangles are counts. "
      "*query*: the structure's answer and the cars on its blocks; *submission*: the GL calls, with the copies of what "
      "is sent again; *drawing*: from there to the return of glFinish.";
  if (const std::size_t dirty = dirty_parts(run); dirty > 0)
    text += " **During " + std::to_string(dirty) + " of the parts other programs had the machine.**";
  if (gl::software_renderer(run.renderer))
    text +=
        " This renderer is software: it transforms and clips within the GL calls, so that submission holds most of "
        "the drawing, and only their sum says something.";
  return text + "\n\n";
}

double times_c1(const PaperRun& run, const std::string& city) {
  return static_cast<double>(city_triangles(run, city)) / static_cast<double>(city_triangles(run, "C1"));
}

std::string table_1_text(std::span<const PaperRow> rows) {
  return "### Table 1, figures 5 and 6: C2 without cars\nAll geometry is sent in every frame, as in the paper, unless "
         "the row says *all resident*.\n\n" +
         table(rows, "1", "frame_ms", "ms") + table(rows, "1", "triangles", "triangles a frame");
}

std::string table_2_text(const PaperRun& run, std::span<const PaperRow> rows) {
  Rows times{{"ours, ms", "BqR", "VAMSplit 8", "VAMSplit 6", "BqR over 8", "BqR over 6", "paper, ms: BqR", "VAMSplit",
              "BqR over VAMSplit", "our triangles: BqR over 8", "BqR over 6"}};
  Rows sizes{{"city", "triangles over C1", "paper", "sent by BqR over C1", "time over C1", "paper"}};
  for (const PaperCity& city : kPaperCities) {
    const std::string name(city.name), bqr = name + ", " + title_of("bqr-paper");
    const auto over = [&](const char* vam, const char* quantity) {
      return find_row(rows, "2", bqr, quantity, title_of(vam));
    };
    const PaperRow *over_8 = over("vam-block8", "frame_ms"), *over_6 = over("vam-block6", "frame_ms");
    if (over_8 == nullptr || over_6 == nullptr) continue;
    times.push_back({name, apps::digits3(over_8->value), apps::digits3(*over_8->reference),
                     apps::digits3(*over_6->reference), interval(*over_8), interval(*over_6), cell(over_8->paper_value),
                     apps::digits3(1000 * city.vam_s), cell(over_8->paper_ratio),
                     interval(*over("vam-block8", "triangles")), interval(*over("vam-block6", "triangles"))});
    const PaperRow* time = find_row(rows, "8", name, "frame_ms", "C1");
    const PaperRow* sent = find_row(rows, "8", name, "triangles", "C1");
    if (time == nullptr || sent == nullptr) continue;
    sizes.push_back({name, apps::digits3(times_c1(run, name)), cell(city.times_c1), interval(*sent), interval(*time),
                     cell(time->paper_ratio)});
  }
  std::string text =
      "### Table 2, figure 8: the six cities\nTime of a frame with the BqR-Tree of whole blocks and with the VAMSplit "
      "R-tree of 8 or 6 blocks a page, all geometry sent in every frame. *Over*: the one's time over the other's; in "
      "the last two columns its triangles.\n\n";
  if (times.size() > 1) text += apps::md_table(times);
  if (sizes.size() > 1)
    text += "Growth with the city, " + title_of("bqr-paper") +
            ": triangles of the whole city, triangles sent, and time, "
            "each over that of C1, beside the paper's:\n\n" +
            apps::md_table(sizes);
  return text;
}

std::string cars_text(std::span<const PaperRow> rows) {
  std::string levels;
  for (const CarLevel& level : kFiveLevels) {
    levels += (levels.empty() ? "" : ", ") + std::to_string(level.triangles) + " triangles from " +
              apps::digits3(level.min_radius_px) + " pixels";
  }
  return "### Table 3, figure 9: cars\nCars of 387 triangles at 10 m/s on the half-streets of C2, each of the block on "
         "its right.\n\n" +
         table(rows, "9", "frame_ms", "ms") +
         "With levels of detail, by the radius in the picture of the ball round a car: " + levels +
         ". The paper gives the triangles, and not from where each level is used.\n\n" +
         table(rows, "3", "frame_ms", "ms") +
         "Geometry that stays on the device, and cars attached to blocks in every frame or when they are seen:\n\n" +
         table(rows, "text", "frame_ms", "ms") + table(rows, "text", "query_ms", "ms a query");
}

std::string grain_table(const GrainTable& grains) {
  Rows lines{{"triangles sent: BqR over"}, {"no structure"}};
  for (const std::uint32_t page : kPageBlocks) lines.push_back({"VAMSplit, blocks a page: " + std::to_string(page)});
  for (std::size_t city = 0; city < grains.size(); ++city) {
    const GrainCounts& counts = grains[city];
    lines[0].emplace_back(kPaperCities[city].name);
    lines[1].push_back(apps::digits3(over(counts.bqr, counts.none)));
    for (std::size_t p = 0; p < counts.vam.size(); ++p)
      lines[p + 2].push_back(apps::digits3(over(counts.bqr, counts.vam[p])));
  }
  return apps::md_table(lines);
}

std::string grain_text(const GrainTable& grains) {
  const GrainCounts& c2 = grains[1];
  const double paper = kPaperBqr.triangles / kPaperVam.triangles;
  std::string text =
      "- **The headline is one of grain.** The paper's BqR-Tree sends " + apps::digits3(paper) +
      " of the triangles of its VAMSplit R-tree, and the paper does not say how many blocks are in a page "
      "of that. On C2 here it is " +
      apps::digits3(over(c2.bqr, c2.vam[0])) + " with one block a page, ";
  for (const std::size_t p : {3, 4})
    text += apps::digits3(over(c2.bqr, c2.vam[p])) + " with " + std::to_string(kPageBlocks[p]) + ", ";
  const auto enough =
      std::find_if(c2.vam.begin(), c2.vam.end(), [&](std::uint64_t vam) { return over(c2.bqr, vam) <= paper; });
  if (enough != c2.vam.end())
    text += "and no more than the paper's with " +
            std::to_string(kPageBlocks[static_cast<std::size_t>(enough - c2.vam.begin())]);
  else
    text += "and nearest to the paper's, " + apps::digits3(over(c2.bqr, c2.vam.back())) + ", with " +
            std::to_string(kPageBlocks.back());
  text += ". So the pages alone make the difference";
  if (std::abs(over(c2.bqr, c2.vam[0]) - 1) < 0.02) text += "; at the same grain there is none";
  return text + " (table above).\n";
}

/// Through the paper's averages without a structure and with the BqR-Tree.
struct PaperLine {
  double fixed_s, triangle_s;
};
PaperLine paper_line() {
  const double triangle_s = (kPaperNone.seconds - kPaperBqr.seconds) / (kPaperNone.triangles - kPaperBqr.triangles);
  return {kPaperBqr.seconds - triangle_s * kPaperBqr.triangles, triangle_s};
}

/// What a triangle costs that is culled, and one that is not.
std::string cost_text(const PaperRun& run) {
  const LaneCosts* none = find_lane(run, {"C2", "none", 0, 0, Residency::resident});
  const LaneCosts* bqr = find_lane(run, {"C2", "bqr-paper", 0, 0, Residency::resident});
  if (none == nullptr || bqr == nullptr) return "";
  const double ms_none = mean(*none, frame_ms), ms_bqr = mean(*bqr, frame_ms);
  const double all = mean(*none, triangle_count), kept = mean(*bqr, triangle_count);
  return "- **Time falls less than triangles.** With all resident a frame of C2 takes " +
         apps::digits3(ms_bqr / ms_none) + " of the time without a structure, for " + apps::digits3(kept / all) +
         " of the triangles (paper: " + apps::digits3(kPaperBqr.seconds / kPaperNone.seconds) + " for " +
         apps::digits3(kPaperBqr.triangles / kPaperNone.triangles) +
         "). A triangle that is kept back would have cost " + apps::digits3(1e6 * (ms_none - ms_bqr) / (all - kept)) +
         " ns on this device, one that is drawn costs " + apps::digits3(1e6 * ms_bqr / kept) +
         " ns with its pixels. The paper's averages are " + apps::digits3(1000 * paper_line().fixed_s) + " ms and " +
         apps::digits3(1e9 * paper_line().triangle_s) + " ns for each triangle that is sent.\n";
}

/// A line through the paper's times of C1 and C2, and how far the other cities are from it.
std::string growth_text(const PaperRun& run, std::span<const PaperRow> rows) {
  const PaperCity &c1 = kPaperCities[0], &c2 = kPaperCities[1];
  const double slope = (c2.bqr_s - c1.bqr_s) / (*c2.times_c1 - *c1.times_c1), fixed = c1.bqr_s - slope;
  double farthest = 0;
  for (const PaperCity& city : kPaperCities)
    farthest =
        std::max(farthest, std::abs((fixed + slope * city.times_c1.value_or(*c2.times_c1 + 1)) / city.bqr_s - 1));
  std::string text = "- **Growth.** The paper's times grow less than its cities. " + apps::digits3(1000 * fixed) +
                     " ms and " + apps::digits3(1000 * slope) +
                     " ms for each C1 of triangles give all six of them to " + apps::digits3(100 * farthest) +
                     " %: a cost that does not grow with the city would be enough. Its table 1 has only " +
                     apps::digits3(1000 * paper_line().fixed_s) + " ms of that, so the triangles of C1 cost more each.";
  const PaperRow* time = find_row(rows, "8", "C6", "frame_ms", "C1");
  const PaperRow* sent = find_row(rows, "8", "C6", "triangles", "C1");
  if (time != nullptr && sent != nullptr)
    text += " Ours follow the triangles that are sent: in C6 " + interval(*sent) + " times as many as in C1 take " +
            interval(*time) + " times as long.";
  if (sent != nullptr && *sent->ratio > times_c1(run, "C6"))
    text += " That is more than the city grows, because the flight looks along x and y, to where C1 was added.";
  return text + "\n";
}

std::string residency_text(const PaperRun& run, std::span<const PaperRow> rows) {
  std::string measured;
  for (const PaperRow& row : rows) {
    if (row.paper_table != "text" || row.quantity != "frame_ms" || row.peer != "bqr-paper") continue;
    measured += (measured.empty() ? "" : "; ") + std::to_string(row.cars) + " cars, " +
                (row.residency == "resident" ? "all resident" : row.residency) + ": " + interval(row);
  }
  if (measured.empty()) return "";
  const char* why = " What is saved here is a copy from memory to memory; the paper's geometry crossed a bus.";
  return "- **Geometry on the device.** The paper measured 15 % with the cars' geometry kept on the card, with a "
         "number "
         "of cars that it does not give, and expects up to 30 % more from keeping all; nobody measured that. Ours, "
         "time over all re-sent: " +
         measured + "." + (gl::software_renderer(run.renderer) ? why : "") + "\n";
}

std::string differences_text(const PaperRun& run, std::span<const PaperRow> rows, const GrainTable& grains) {
  return "### Where ours differ, and what could explain it\n" + grain_text(grains) + cost_text(run) +
         growth_text(run, rows) + residency_text(run, rows) +
         "- **C6 has 7.6 times the triangles of C1**, as C2 and three C1 have; the paper's text says 6.5.\n"
         "- Not public, and so ours: the city, with some of its triangles in parked cars; the places of the flight; "
         "the page of the R-tree; where levels of detail change; how many cars turn at a crossing.\n\n";
}

std::string image(std::span<const std::string> plots, const std::string& name) {
  const bool drawn = std::find(plots.begin(), plots.end(), name) != plots.end();
  return drawn ? "![" + name + "](" + name + ".svg)\n\n" : "";
}

}  // namespace

std::string paper_text(const PaperRun& run, std::span<const PaperRow> rows, const GrainTable& grains,
                       std::span<const std::string> plots) {
  return head_text(run) + table_1_text(rows) + image(plots, "paper_fig5") + image(plots, "paper_fig6") +
         table_2_text(run, rows) + image(plots, "paper_fig8") + cars_text(rows) + image(plots, "paper_fig9") +
         "### The grain of the pages\nCounts over the flight's " + std::to_string(run.options.frames) +
         " frames, whole blocks against whole pages of blocks:\n\n" + grain_table(grains) +
         differences_text(run, rows, grains);
}

}  // namespace manzana::paper
