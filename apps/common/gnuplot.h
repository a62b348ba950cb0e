#pragma once
/// Plots as SVG, drawn by gnuplot from scripts that stay beside them.
///   std::vector<std::string> drawn = draw_all(out, {{"path_C2", gnuplot_head("path_C2") + "plot sin(x)\n"}});
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace manzana::apps {

struct Script {
  std::string name, text;
};

/// What every script begins with: an SVG of that name, data separated by commas, `?` for what was not measured.
std::string gnuplot_head(const std::string& name);

std::string in_quotes(std::string_view text);

/// The command `plot` with these parts.
std::string plot_command(const std::vector<std::string>& parts);

/// Writes OUT/plots/NAME.gp and draws OUT/NAME.svg; gives the names of those that were drawn. Without gnuplot says so
/// on stderr, in one line, and gives none.
std::vector<std::string> draw_all(const std::filesystem::path& out, const std::vector<Script>& scripts);

}  // namespace manzana::apps
