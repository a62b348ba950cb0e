#include "apps/common/program.h"

#include <CLI/CLI.hpp>
#include <catch2/catch.hpp>
#include <stdexcept>

using namespace manzana::apps;

namespace {

std::optional<Reply> parse_one(const std::vector<const char*>& arguments, int& number) {
  CLI::App app("What it does.", "some-program");
  app.add_option("--number", number, "a number")->check(CLI::Range(1, 9));
  return parse(app, static_cast<int>(arguments.size()), arguments.data());
}

}  // namespace

TEST_CASE("program: options are read, or the reply says what to print and how to end") {
  int number = 0;
  CHECK_FALSE(parse_one({"x", "--number", "7"}, number));
  CHECK(number == 7);
  const auto help = parse_one({"x", "--help"}, number);
  REQUIRE(help);
  CHECK(help->exit_code == 0);
  CHECK(help->text.find("--number") != std::string::npos);
  const auto wrong = parse_one({"x", "--number", "10"}, number);
  REQUIRE(wrong);
  CHECK(wrong->exit_code == 2);
  CHECK(wrong->text.starts_with("some-program: "));
  CHECK(wrong->text.find('\n') == wrong->text.size() - 1);
}

TEST_CASE("program: the body's code, or 1 when it throws") {
  CHECK(guarded("p", "s", [] { return 5; }) == 5);
  CHECK(guarded("p", "s", []() -> int { throw std::runtime_error("of this test:\nexpected"); }) == 1);
  CHECK(guarded("p", "of this test", []() -> int { throw std::bad_alloc(); }) == 1);
}
