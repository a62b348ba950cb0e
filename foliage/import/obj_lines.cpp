#include "foliage/import/obj_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace manzana::foliage {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f' || c == '\0'; }

/// Up to the next end of line, which goes too.
std::string_view cut_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  return text;
}

/// Where a word begins with #; names may hold one.
std::size_t comment_in(std::string_view line) {
  for (std::size_t i = 0; i < line.size(); ++i)
    if (line[i] == '#' && (i == 0 || is_blank(line[i - 1]))) return i;
  return line.size();
}

}  // namespace

void ObjLine::fail(const std::string& what) const {
  throw std::runtime_error("line " + std::to_string(number_) + ": " + what);
}

void ObjLine::fail_word(std::string_view word, const char* what) const {
  std::string message("\"");
  message.append(word.substr(0, 40)).append("\" ").append(what);
  fail(message);
}

void ObjLine::skip_blanks() {
  while (!text_.empty() && is_blank(text_.front())) text_.remove_prefix(1);
}

std::string_view ObjLine::word() {
  skip_blanks();
  const auto end = std::find_if(text_.begin(), text_.end(), is_blank);
  const auto size = static_cast<std::size_t>(end - text_.begin());
  const std::string_view word = text_.substr(0, size);
  text_.remove_prefix(size);
  return word;
}

std::string_view ObjLine::rest() { return trimmed(text_); }

double ObjLine::need_number() {
  std::string_view text = word();
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(std::abs(value) <= 1e9))
    fail_word(text, "is no number, or out of range");
  return value;
}

double ObjLine::number_or(double otherwise) {
  skip_blanks();
  return text_.empty() ? otherwise : need_number();
}

std::optional<ObjLine> ObjLines::next() {
  while (!text_.empty()) {
    std::string_view line = trimmed(cut_line(text_));
    const std::size_t first = ++number_;
    if (line.ends_with('\\')) {
      joined_.clear();
      while (line.ends_with('\\')) {
        joined_.append(line.substr(0, line.size() - 1)).append(1, ' ');
        line = trimmed(cut_line(text_));
        ++number_;
      }
      line = joined_.append(line);
    }
    line = trimmed(line.substr(0, comment_in(line)));
    if (!line.empty()) return ObjLine(line, first);
  }
  return std::nullopt;
}

}  // namespace manzana::foliage
