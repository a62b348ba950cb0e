#pragma once
/// What every program here does alike: what it says to --help, --version and wrong usage, and how it fails.
///   const auto parsed = parse_options(argc, argv);                  // apps::Parsed<Options>
///   if (!parsed.options) return apps::reply(parsed);
///   return apps::guarded("manzana-x", parsed.options->city, [&] { return run(*parsed.options); });
#include <cstdio>
#include <functional>
#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace manzana::apps {

/// A text to print and the code to exit with: 0 with a text for stdout, 2 with a line for stderr.
struct Reply {
  std::string text;
  int exit_code = 0;
};

/// Either options, or a reply.
template <class Options>
struct Parsed {
  std::optional<Options> options;
  std::string text;
  int exit_code = 0;
};

/// Nothing when the arguments suit the app, whose variables are set then.
std::optional<Reply> parse(CLI::App& app, int argc, const char* const* argv);

/// For wrong usage that only shows when all options are known.
Reply wrong_usage(const std::string& program, const std::string& what);

template <class Options>
int reply(const Parsed<Options>& parsed) {
  std::fputs(parsed.text.c_str(), parsed.exit_code == 0 ? stdout : stderr);
  return parsed.exit_code;
}

/// What the body returns; 1, with one line on stderr, when it throws. `subject` is named when memory ends.
int guarded(const std::string& program, const std::string& subject, const std::function<int()>& body);

}  // namespace manzana::apps
