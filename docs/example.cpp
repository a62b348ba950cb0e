#include <iostream>

#include "scenegraph/import/import.h"
#include "scenegraph/visible.h"

int main() {
  using namespace manzana;
  const Imported city = import_city("builtin:town", {}, {});  // or a file: helsinki.osm.pbf
  VisibleSets seen(city.scene);
  const culling::View view = culling::look({0, -700, 2}, {0, 1, 0}, {0, 0, 1}, 1.05, 16.0 / 9.0);
  find_visible(city.scene, view, Structure::bqr, seen);
  find_cars(city.scene, ticks(60.0), seen);
  std::cout << count(city.scene.buildings.table, seen.objects()) << " of " << city.scene.buildings.table.size()
            << " buildings, " << seen.cars.size() << " of " << city.scene.traffic.cars() << " cars in view\n";
}
