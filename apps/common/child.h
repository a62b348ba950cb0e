#pragma once
/// Other programs, run and listened to.
///   watch_for_interrupts();                                                // once
///   int code = run_child({"/proc/self/exe", "--process", "1"}, [](const std::string& line) { ... });
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace manzana::apps {

/// From here on SIGINT, SIGTERM and SIGHUP end a wait for a child, and with it the child, by Interrupted.
void watch_for_interrupts();

struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted") {}
};

/// For work of our own between children.
void throw_if_interrupted();

/// Gives each whole line of the child's stdout, and returns its exit code; 128 + signal when it was killed, 127 when it
/// cannot be run. Throws Interrupted, and what `line` throws, after the child has ended.
int run_child(const std::vector<std::string>& command, const std::function<void(const std::string&)>& line);

/// For a child: ends it when its parent ends.
void end_with_parent();

}  // namespace manzana::apps
