#include "apps/common/progress_bar.h"

#include <unistd.h>

#include <algorithm>

namespace manzana::apps {
namespace {

constexpr int kBarWidth = 30;

std::string bar_of(int percent) {
  const auto filled = static_cast<std::size_t>(percent * kBarWidth / 100);
  return std::string(filled, '#') + std::string(kBarWidth - filled, '.');
}

}  // namespace

ProgressBar::ProgressBar(std::FILE* out) : ProgressBar(out, isatty(fileno(out)) != 0) {}
ProgressBar::ProgressBar(std::FILE* out, bool terminal) : out_(out), terminal_(terminal) {}
ProgressBar::~ProgressBar() { end_line(); }

void ProgressBar::end_line() {
  if (open_) std::fputc('\n', out_);
  open_ = false;
}

void ProgressBar::show(std::string_view stage, double fraction) {
  const int percent = fraction > 0 ? static_cast<int>(std::min(fraction, 1.0) * 100) : 0;
  const int step = terminal_ ? percent : percent / 25 * 25;
  if (stage == stage_ && step == shown_) return;
  if (stage != stage_) end_line();
  stage_ = stage;
  shown_ = step;
  if (terminal_)
    std::fprintf(out_, "\r%-12s [%s] %3d %%", stage_.c_str(), bar_of(step).c_str(), step);
  else
    std::fprintf(out_, "%s: %d %%\n", stage_.c_str(), step);
  open_ = terminal_;
  std::fflush(out_);
}

}  // namespace manzana::apps
