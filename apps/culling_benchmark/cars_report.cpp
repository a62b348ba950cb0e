#include <array>

#include "apps/common/csv.h"
#include "apps/common/markdown.h"
#include "apps/culling_benchmark/cars.h"
#include "files/whole_file.h"

namespace manzana::culling_benchmark {
namespace {

using C = apps::Column<CarsRow>;
constexpr std::array kColumns{
    C{"cars", "", "that move in the city", &CarsRow::cars},
    C{"blocks", "", "of the city", &CarsRow::blocks},
    C{"metres_a_frame", "m", "how far the camera moves from one frame to the next", &CarsRow::metres_a_frame},
    C{"in_view", "", "cars handed to drawing, mean of the frames", &CarsRow::in_view},
    C{"half_streets", "", "bisected, mean of the frames", &CarsRow::half_streets},
    C{"looked_at", "", "cars found on them or just behind, mean of the frames", &CarsRow::looked_at},
    C{"query_us", "us", "which objects and blocks are seen", &CarsRow::query_us},
    C{"find_us", "us", "which cars are on those blocks, where they are, which of them are seen", &CarsRow::find_us},
    C{"lists_us", "us", "their levels of detail, and the lists that drawing reads", &CarsRow::lists_us},
    C{"all_us", "us", "all three", &CarsRow::all_us},
    C{"ratio", "", "of all_us to that of the first city, median of the rounds", &CarsRow::ratio},
    C{"ratio_lo", "", "95 % interval", &CarsRow::ratio_lo},
    C{"ratio_hi", "", "", &CarsRow::ratio_hi},
};

std::string flight_md(const CarsRun& run, double metres_a_frame) {
  std::vector<std::vector<std::string>> cells{{"cars", "in view", "half-streets bisected", "cars looked at", "query us",
                                               "finding us", "lists us", "all us", "x first"}};
  for (const CarsRow& r : run.rows)
    if (r.metres_a_frame == metres_a_frame)
      cells.push_back(
          {apps::grouped(static_cast<double>(r.cars)), apps::grouped(r.in_view), apps::grouped(r.half_streets),
           apps::grouped(r.looked_at), apps::digits3(r.query_us), apps::digits3(r.find_us), apps::digits3(r.lists_us),
           apps::digits3(r.all_us),
           apps::digits3(r.ratio) + " [" + apps::digits3(r.ratio_lo) + ", " + apps::digits3(r.ratio_hi) + "]"});
  return "A camera that moves " + apps::digits3(metres_a_frame) + " m a frame:\n\n" + apps::md_table(cells);
}

std::string verdict(const CarsRun& run) {
  const CarsRow* worst = &run.rows.front();
  for (const CarsRow& r : run.rows)
    if (r.ratio_hi > worst->ratio_hi) worst = &r;
  return "Meant to be under " + apps::digits3(kMostCarsGrowth) +
         " times the first city's: " + (worst->ratio_hi < kMostCarsGrowth ? "met" : "**not met**") + ", " +
         apps::digits3(worst->ratio) + " at most.\n\n";
}

}  // namespace

void write_cars(const std::filesystem::path& folder, const CarsRun& run) {
  files::write_whole(folder / "cars.csv", apps::to_csv<CarsRow>(run.rows, kColumns));
}

std::string cars_columns_md() { return "\n## cars.csv\n" + explain<CarsRow>(kColumns); }

std::string cars_md(const CarsRun& run) {
  std::string text =
      "## Moving cars\nThe same number of cars in view, in cities of ever more cars. *Query*: the objects and blocks "
      "in "
      "view. *Finding*: the cars on the half-streets of those blocks by bisection, their places, and on blocks that "
      "cross the view's sides which of them are seen. *Lists*: levels of detail, and an instance a car as the device "
      "reads it. One process, " +
      std::to_string(run.options.rounds) +
      " rounds, the cities in an order that chance decides in each. A car that is not on such a block is not "
      "touched, so that the first city, all of which is in view, has only the bisections and what lies nearer in "
      "memory for it.\n\n";
  for (const CarsFlight& flight : run.options.flights) text += flight_md(run, flight.metres_a_frame);
  return text + verdict(run);
}

}  // namespace manzana::culling_benchmark
