#include <catch2/catch.hpp>
#include <chrono>
#include <iostream>
#include "towns.h"
using namespace manzana;
TEST_CASE("town size") {
  const Town town = grid_town(17, 17, 100, 15, 0, 1);
  const auto t0 = std::chrono::steady_clock::now();
  const Traffic traffic = traffic_of(town);
  const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - t0).count();
  std::cout << town.graph.edges.size() << " edges " << town.graph.junctions.size() << " junctions "
            << traffic.halves.size() << " halves " << traffic.circuits.size() << " circuits " << traffic.cars()
            << " cars, ms " << ms << "\n";
  CHECK(traffic.cars() >= 2000);
}
