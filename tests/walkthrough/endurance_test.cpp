#include "apps/walkthrough/endurance.h"

#include <catch2/catch.hpp>

#include "scenegraph/import/import.h"

namespace manzana::walkthrough {

TEST_CASE("endurance: over a day every car is in one block at any time") {
  const Imported city = import_city("builtin:town", {.cars = 700}, {});
  Endurance day;
  for (int minute = 0; minute <= 24 * 60; minute += 7) day.see(city.scene, 60.0 * minute + 0.123, 1000, minute / 60);
  CHECK(day.rows.back().hours > 23.9);
  CHECK(day.cars == city.scene.traffic.cars());
  CHECK_FALSE(drift(day).has_value());
}

TEST_CASE("endurance: a car too many and bytes that grow are drift and those of the first laps are not") {
  Endurance day{.cars = 5, .rows = {}};
  for (int i = 0; i < 8; ++i) day.rows.push_back({3.0 * i, 5, i < 4 ? 10.0 + i : 14.0, i < 4 ? 50.0 + i : 60.0, i / 2});
  CHECK_FALSE(drift(day).has_value());
  Endurance car = day, device = day, host = day;
  car.rows[1].cars = 6;
  device.rows[7].device_mb += 0.001;
  host.rows[7].host_mb += 3;
  CHECK(drift(car).value().starts_with("6 of 5 cars after 3"));
  CHECK(drift(device).value().starts_with("the device holds 14.001"));
  CHECK(drift(host).value().starts_with("the host holds 63.0"));
}

}  // namespace manzana::walkthrough
