#pragma once
/// Real files for tests: MANZANA_DATA names the folder. Set: a missing file is a failure. Unset: the case is skipped.
///   const auto file = data_file("osm/helsinki-centre.osm.pbf");
///   if (!file) return;
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>

inline std::optional<std::filesystem::path> data_file(const std::string& name) {
  const char* root = std::getenv("MANZANA_DATA");
  if (root == nullptr || *root == '\0') {
    std::cout << "SKIPPED: MANZANA_DATA is not set\n";
    return std::nullopt;
  }
  const auto path = std::filesystem::path(root) / name;
  INFO("MANZANA_DATA has no " << name);
  REQUIRE(std::filesystem::exists(path));
  return path;
}
