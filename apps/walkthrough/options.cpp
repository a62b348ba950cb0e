#include "apps/walkthrough/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>

#include "foliage/import/species.h"

namespace manzana::walkthrough {
namespace {

std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for (const foliage::Law law : foliage::all_laws()) names.emplace_back(name_of(law));
  return names;
}

constexpr int kLargestSide = 16384;  // of a framebuffer, on every device that has GL 4.5

constexpr const char* kAbout =
    "Walk, fly and drive through a city. CITY is builtin:town, an OpenStreetMap file (.osm, .osm.gz,\n"
    ".osm.bz2, .osm.pbf), CityJSON (.city.json, .city.jsonl) or baked (.manzana). F1 in the window shows the keys. "
    "Without a\n"
    "display, or with --headless, a camera path is drawn to pictures, frames.csv and summary.json.\n"
    "Exit: 0 success, 1 bad input, 2 wrong usage.";

std::optional<int> parse_int(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<draw::Size> parse_size(const std::string& text) {
  const std::size_t x = text.find('x');
  if (x == std::string::npos) return std::nullopt;
  const auto width = parse_int(std::string_view(text).substr(0, x));
  const auto height = parse_int(std::string_view(text).substr(x + 1));
  const auto fits = [](std::optional<int> side) { return side && *side >= 1 && *side <= kLargestSide; };
  if (!fits(width) || !fits(height)) return std::nullopt;
  return draw::Size{*width, *height};
}

std::optional<PlantFile> parse_plant(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals + 1 == text.size()) return std::nullopt;
  const auto species = std::ranges::find(foliage::kSpeciesNames, text.substr(0, equals));
  if (species == foliage::kSpeciesNames.end()) return std::nullopt;
  return PlantFile{static_cast<PlantSpecies>(species - foliage::kSpeciesNames.begin()), text.substr(equals + 1)};
}

/// CLI::Range lets what is no number pass, since no comparison holds.
CLI::Validator within(double low, double high) {
  const auto check = [=](const std::string& text) {
    double value = 0;
    const bool ok = CLI::detail::lexical_cast(text, value) && value >= low && value <= high;
    return ok ? std::string() : "is not between " + std::to_string(low) + " and " + std::to_string(high) + ": " + text;
  };
  return {check, "", "within"};
}

/// CLI11 sees strings; what they must look like is checked here, so that its messages name the option.
struct Texts {
  std::string only;
  std::string size = "1280x720", structure, tree_law, dispatch = "batched";
  std::vector<std::string> plants, tree_columns;
};

/// "height=h_tree" into the member of that name. False: no such member, or no name after it.
bool set_column(TreeColumns& columns, const std::string& text) {
  const std::array<std::pair<std::string_view, std::string TreeColumns::*>, 7> known{
      {{"lat", &TreeColumns::lat},
       {"lon", &TreeColumns::lon},
       {"x", &TreeColumns::x},
       {"y", &TreeColumns::y},
       {"species", &TreeColumns::species},
       {"height", &TreeColumns::height},
       {"crown", &TreeColumns::crown}}};
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals + 1 == text.size()) return false;
  for (const auto& [name, member] : known)
    if (name == text.substr(0, equals)) return columns.*member = text.substr(equals + 1), true;
  return false;
}

void add_options(CLI::App& app, Options& options, Texts& texts) {
  app.add_option(
         "CITY", options.city,
         "builtin:town, a file of OpenStreetMap or CityJSON, or an ecosystem of plants (.json); without it, but\n"
         "with --trees, those alone")
      ->capture_default_str();
  app.add_option("--add", options.more, "another city into the same scene; may be given again")
      ->allow_extra_args(false);
  app.add_option("--trees", options.tree_lists, "a list of trees: .csv or .geojson; may be given again")
      ->allow_extra_args(false);
  app.add_option("--tree-columns", texts.tree_columns,
                 "lat=NAME,lon=NAME (or x, y), species=NAME,height=NAME,crown=NAME: what the lists call them; the\n"
                 "crown's is its diameter")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(
          [](const std::string& text) {
            TreeColumns columns;
            return std::string(set_column(columns, text) ? "" : "is no column like height=NAME: " + text);
          },
          "");
  app.add_option("--crs", options.reference_system, "reference system of files that name none, as EPSG:28992");
  app.add_option("--terrain", options.terrain, "relief to stand on: GeoTIFF or SRTM (.tif, .hgt, .hgt.zip)");
  app.add_option("--orthophoto", options.orthophoto,
                 "a picture from above that is laid over the ground: GeoTIFF, or PNG or JPEG with a world file");
  app.add_option("--lod", options.lod, "of CityJSON: the finest level of detail to take")->check(within(0, 10));
  app.add_flag("--headless", options.headless, "draw a camera path to files, without a window");
  app.add_option("--path", options.path, "camera path: tour, pina or a JSON file")->capture_default_str();
  app.add_option("--frames", options.frames, "frames that the whole path is spread over")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app.add_option("--every", options.every, "write every K-th frame as a picture")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  app.add_option("--size", texts.size, "WIDTHxHEIGHT of pictures and window")
      ->check(
          [](const std::string& text) { return std::string(parse_size(text) ? "" : "is no WIDTHxHEIGHT: " + text); },
          "")
      ->capture_default_str();
  app.add_option("--structure", texts.structure,
                 "bqr: cull by the BqR-Tree; none: draw everything. Without it bqr, at quality exact none")
      ->check(CLI::IsMember({"bqr", "none"}));
  app.add_option("--only", texts.only,
                 "what is looked for, as building20,conifer: of building, building10, building20, building40 (metres), "
                 "street, tree, tree15, broadleaf, conifer, shrub, car")
      ->check(
          [](const std::string& text) {
            try {
              (void)classes_named(text);
              return std::string();
            } catch (const std::invalid_argument& error) {
              return std::string(error.what());
            }
          },
          "");
  app.add_option("--out", options.out, "folder for pictures, frames.csv, summary.json, recorded paths")
      ->capture_default_str();
  app.add_option("--quality", options.quality,
                 "fast, balanced, accurate: what may be wrong, in pixels, as measured in trees; exact: nothing is\n"
                 "left out, nor culled. Without it balanced; in software fast, with one sample a pixel")
      ->check(CLI::IsMember(draw::quality_names()));
  app.add_option(
         "--gpu-mb", options.gpu_mb,
         "megabytes of the device that may be used: meshes that were not seen for longest give way; 0: no limit")
      ->check(within(0, 1e6))
      ->capture_default_str();
  app.add_flag("--report-memory", options.report_memory,
               "with --headless: what each part holds, and how much of it the path needed");
  app.add_option("--hours", options.hours,
                 "with --headless: the frames are spread over so many hours of traffic, the path is driven again and\n"
                 "again, and it ends with 1 if cars or memory did not stay the same")
      ->check(within(0, 10000));
  app.add_option("--seed", options.seed, "of scattered trees, cars and the built-in town")
      ->check([](const std::string& text) { return std::string(text.starts_with('-') ? "is negative: " + text : ""); },
              "")
      ->capture_default_str();
  app.add_option("--cars", options.cars, "how many; without it the length of the streets decides")
      ->check(CLI::Range(0, 1000000));
  app.add_option("--tree-error", options.tree_error_px,
                 "pixels that may be wrong in trees; without it the quality decides")
      ->check(within(0.01, 1000));
  app.add_option("--tree-vertices", options.tree_vertices, "budget of a frame that may raise the error; 0: none")
      ->check(within(0, 1e9))
      ->capture_default_str();
  app.add_option("--tree-ms", options.tree_ms,
                 "milliseconds of a whole frame; trees take what the rest leaves, and the error may rise; 0: no limit")
      ->check(within(0, 1e6))
      ->capture_default_str();
  app.add_option("--tree-law", texts.tree_law,
                 "how trees lose detail: ours, as a source does, or full for all of it; without it the quality\n"
                 "decides")
      ->check(CLI::IsMember(law_names()));
  app.add_flag("!--no-packs", options.packs, "far trees are drawn as near ones are, not as mosaics of their species");
  app.add_option("--sun", options.sun_deg,
                 "AZIMUTH,HEIGHT in degrees: where it stands, from the north over the east; HEIGHT: 0 to 90")
      ->delimiter(',')
      ->check(within(-360, 360).application_index(0))
      ->check(within(0, 90).application_index(1));
  app.add_flag("!--no-wind", options.wind, "trees stand still");
  app.add_option("--dispatch", texts.dispatch, "batched: all trees at once; node: each visible node's for itself")
      ->check(CLI::IsMember({"batched", "node"}))
      ->capture_default_str();
  app.add_option("--plant", texts.plants,
                 "SPECIES=FILE.glb: model for oak, birch, pine, ...; for broadleaf, conifer or shrub: for all of that "
                 "kind that\n"
                 "have none of their own")
      ->check(
          [](const std::string& text) { return std::string(parse_plant(text) ? "" : "is no SPECIES=FILE: " + text); },
          "");
}

Options finish(Options options, const Texts& texts) {
  options.size = *parse_size(texts.size);
  const std::string by_quality = options.quality == "exact" ? "none" : "bqr";
  options.structure =
      (texts.structure.empty() ? by_quality : texts.structure) == "none" ? Structure::none : Structure::bqr;
  if (!texts.tree_law.empty()) options.tree_law = foliage::law_named(texts.tree_law);
  if (!texts.only.empty()) options.only = classes_named(texts.only);
  options.trees_by_node = texts.dispatch == "node";
  for (const std::string& column : texts.tree_columns) set_column(options.tree_columns, column);
  for (const std::string& plant : texts.plants) options.plants.push_back(*parse_plant(plant));
  return options;
}

}  // namespace

Parsed parse_options(int argc, const char* const* argv) {
  CLI::App app(kAbout, "manzana-walkthrough");
  app.set_version_flag("--version", "manzana-walkthrough " MANZANA_VERSION);
  Options options;
  Texts texts;
  add_options(app, options, texts);
  if (auto reply = apps::parse(app, argc, argv)) return {std::nullopt, std::move(reply->text), reply->exit_code};
  if (app.count("CITY") == 0 && !options.tree_lists.empty()) options.city.clear();
  return {finish(std::move(options), texts), {}, 0};
}

const char* name_of(Structure structure) { return structure == Structure::bqr ? "bqr" : "none"; }

}  // namespace manzana::walkthrough
