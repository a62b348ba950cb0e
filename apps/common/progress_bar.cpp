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

void ProgressBar::show(std::string_view stage, double fraction, std::string_view note) {
  const int percent = fraction > 0 ? static_cast<int>(std::min(fraction, 1.0) * 100) : 0;
  const int step = terminal_ ? percent : percent / 25 * 25;
  const bool same_note = !terminal_ || note == note_;
  if (stage == stage_ && step == shown_ && same_note) return;
  if (stage != stage_) end_line();
  stage_ = stage;
  shown_ = step;
  note_ = note;
  const std::string after = note.empty() ? "" : ", " + std::string(note);
  if (terminal_)
    std::fprintf(out_, "\r\033[K%-12s [%s] %3d %%%s", stage_.c_str(), bar_of(step).c_str(), step, after.c_str());
  else
    std::fprintf(out_, "%s: %d %%%s\n", stage_.c_str(), step, after.c_str());
  open_ = terminal_;
  std::fflush(out_);
}

std::string time_left(double seconds) {
  const bool long_time = seconds >= 100;
  return "about " + std::to_string(static_cast<int>(long_time ? seconds / 60 + 0.5 : seconds)) +
         (long_time ? " min left" : " s left");
}

}  // namespace manzana::apps
