#include "apps/common/gnuplot.h"

#include <algorithm>
#include <cstdio>

#include "apps/common/child.h"
#include "files/whole_file.h"

namespace manzana::apps {
namespace {

/// 0 when it is there; 127 without a gnuplot.
int draw(const std::filesystem::path& out, const Script& script) {
  const std::string file = "plots/" + script.name + ".gp";
  files::write_whole(out / file, script.text);
  const int code =
      run_child({"sh", "-c", "cd \"$0\" && exec gnuplot \"$1\"", out.string(), file}, [](const std::string&) {});
  if (code == 0) std::filesystem::rename(out / (script.name + ".svg.part"), out / (script.name + ".svg"));
  return code;
}

}  // namespace

std::string gnuplot_head(const std::string& name) {
  return "# run this in the folder above\n"
         "set terminal svg size 900,760 dynamic font 'sans-serif,14' background 'white'\nset encoding utf8\n"
         "set output '" +
         name +
         ".svg.part'\nset datafile separator ','\nset datafile missing '?'\n"
         "set grid lt 1 lw 0.5 lc rgb '#cccccc'\nset tics nomirror\nset border 3\n"
         "set key outside right top noenhanced\nset lmargin 12\nset rmargin 20\n";
}

std::string in_quotes(std::string_view text) {
  std::string out(1, '\'');
  for (const char c : text) out.append(c == '\'' ? 2 : 1, c);
  return out += '\'';
}

std::string plot_command(const std::vector<std::string>& parts) {
  std::string text = "plot ";
  for (const std::string& part : parts) {
    if (&part != &parts.front()) text += ", \\\n  ";
    text += part;
  }
  return text += '\n';
}

std::vector<std::string> draw_all(const std::filesystem::path& out, const std::vector<Script>& scripts) {
  std::vector<std::string> drawn;
  int worst = 0;
  files::make_folder(out / "plots");
  for (const Script& script : scripts) {
    const int code = draw(out, script);
    if (code == 0) drawn.push_back(script.name);
    worst = std::max(worst, code);
  }
  if (worst != 0)
    std::fprintf(stderr, "%s: not all plots are drawn; their scripts are in %s\n",
                 worst == 127 ? "gnuplot is not installed" : "gnuplot failed", (out / "plots").c_str());
  return drawn;
}

}  // namespace manzana::apps
