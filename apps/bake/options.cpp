#include "apps/bake/options.h"

#include <CLI/CLI.hpp>
#include <stdexcept>

namespace manzana::bake {
namespace {

constexpr const char* kAbout =
    "Prepare what is drawn, so that drawing does not wait for it.\n"
    "Exit: 0 success, 1 bad input, 2 wrong usage.";
constexpr const char* kPlant =
    "Prepare a plant for every distance, and say what was taken for what. FILE is glTF (.glb, .gltf),\n"
    "OBJ (.obj), L-systems or the parameters of a species (.json); FILE#NAME chooses one of several\n"
    "L-systems.";

}  // namespace

Parsed parse_options(int argc, const char* const* argv) {
  CLI::App app(kAbout, "manzana-bake");
  app.set_version_flag("--version", "manzana-bake " MANZANA_VERSION);
  app.require_subcommand(1);
  std::string source, visibility = "best";
  Options options;
  CLI::App* plant = app.add_subcommand("plant", kPlant);
  plant->add_option("FILE", source, "what to read")->required();
  plant->add_option("-o,--out", options.out, "the prepared plant to write, FILE.plant")->required();
  plant
      ->add_option("--visibility", visibility,
                   "who counts what is seen of each cell of leaves: gpu, cpu, queries (occlusion queries on the GPU,\n"
                   "the reference), none; best: the GPU, or the CPU where GL is software or absent")
      ->check([](const std::string& name) -> std::string {
        try {
          return visibility_named(name), std::string();
        } catch (const std::invalid_argument& error) {
          return name + " " + error.what();
        }
      })
      ->capture_default_str();
  if (auto reply = apps::parse(app, argc, argv)) return {std::nullopt, std::move(reply->text), reply->exit_code};
  options.visibility = visibility_named(visibility);
  options.source = foliage::parse_plant_source(source);
  return {std::move(options), {}, 0};
}

}  // namespace manzana::bake
