#include "apps/common/program.h"

#include <CLI/CLI.hpp>
#include <exception>
#include <new>

namespace manzana::apps {
namespace {

std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  for (char& c : text) c = c == '\n' ? ' ' : c;
  return text;
}

int fail(const std::string& program, const std::string& what) {
  std::fprintf(stderr, "%s: %s\n", program.c_str(), one_line(what).c_str());
  return 1;
}

}  // namespace

Reply wrong_usage(const std::string& program, const std::string& what) {
  return {program + ": " + one_line(what) + " (see --help)\n", 2};
}

std::optional<Reply> parse(CLI::App& app, int argc, const char* const* argv) {
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::CallForHelp&) {
    return Reply{app.help(), 0};
  } catch (const CLI::CallForVersion& version) {
    return Reply{std::string(version.what()) + "\n", 0};
  } catch (const CLI::ParseError& error) {
    return wrong_usage(app.get_name(), error.what());
  }
}

int guarded(const std::string& program, const std::string& subject, const std::function<int()>& body) {
  try {
    return body();
  } catch (const std::bad_alloc&) {
    return fail(program, subject + ": not enough memory");
  } catch (const std::exception& error) {
    return fail(program, error.what());
  }
}

}  // namespace manzana::apps
