#pragma once
/// OBJ and MTL files as lines of words. Nothing is copied; nothing throws but what says so.
#include <optional>
#include <string>
#include <string_view>

namespace manzana::foliage {

/// Takes words, numbers and the rest from a line's front. Blanks and tabs part words.
class ObjLine {
 public:
  ObjLine() = default;
  ObjLine(std::string_view text, std::size_t number) : text_(text), number_(number) {}

  std::string_view word();  ///< empty at the end
  std::string_view rest();  ///< without blanks at its ends
  std::size_t number() const { return number_; }

  /// Finite and at most 1e9 in size. Throws std::runtime_error ("line 12: ...").
  double need_number();
  double number_or(double otherwise);

  [[noreturn]] void fail(const std::string& what) const;
  [[noreturn]] void fail_word(std::string_view word, const char* what) const;  ///< "word" what

 private:
  void skip_blanks();

  std::string_view text_;
  std::size_t number_ = 0;  // from 1
};

/// The lines of a text, without comments and empty ones. A backslash at the end joins the next line.
class ObjLines {
 public:
  explicit ObjLines(std::string_view text) : text_(text) {}
  std::optional<ObjLine> next();

 private:
  std::string_view text_;
  std::size_t number_ = 0;
  std::string joined_;  // of continued lines
};

}  // namespace manzana::foliage
