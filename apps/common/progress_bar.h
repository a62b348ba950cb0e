#pragma once
/// How far a long task is: a bar that redraws itself on a terminal, plain lines (four a stage) otherwise.
///   ProgressBar bar(stderr);
///   bar.show("reading", 0.4);
#include <cstdio>
#include <string>
#include <string_view>

namespace manzana::apps {

class ProgressBar {
 public:
  explicit ProgressBar(std::FILE* out);        ///< asks whether it is a terminal
  ProgressBar(std::FILE* out, bool terminal);  ///< for tests
  ~ProgressBar();                              ///< ends the line of a bar
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// A stage that is new begins at what is done of it; fractions beyond [0, 1] are clamped. The note follows the bar.
  void show(std::string_view stage, double fraction, std::string_view note = {});

 private:
  void end_line();

  std::FILE* out_;
  bool terminal_;
  bool open_ = false;  // a bar stands on the last line
  std::string stage_, note_;
  int shown_ = -1;  // percent on the terminal, quarters otherwise
};

/// "about 12 min left", "about 40 s left"
std::string time_left(double seconds);

}  // namespace manzana::apps
