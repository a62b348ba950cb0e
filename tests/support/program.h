#pragma once
/// Runs a program as a user would, and says how it ended and what it took.
///   const Ended ended = run_program(MANZANA_WALKTHROUGH, folder, {"--version"});
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fcntl.h>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

#if defined(__SANITIZE_ADDRESS__)
inline constexpr double kSlower = 6, kLarger = 4;  // what the sanitizers cost
#else
inline constexpr double kSlower = 1, kLarger = 1;
#endif

struct Ended {
  int code = -1;  ///< of exit; 128 + signal when it was killed
  double cpu_s = 0, memory_mb = 0;
  std::string out, err;
};

/// Starts it without a display; `folder` takes its output. Wait for it with wait_for.
inline pid_t start_program(const std::string& program, const std::filesystem::path& folder,
                           const std::vector<std::string>& arguments) {
  constexpr auto kMostCpu = static_cast<rlim_t>(120 * kSlower);  // seconds: a hang ends the test, not the day
  const std::string out = folder / "stdout.txt", err = folder / "stderr.txt";
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const rlimit cpu{kMostCpu, kMostCpu};
    setrlimit(RLIMIT_CPU, &cpu);
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 1);
    dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), 2);
    execv(program.c_str(), argv.data());
    _exit(127);
  }
  return child;
}

inline Ended wait_for(pid_t child, const std::filesystem::path& folder) {
  int status = 0;
  rusage usage{};
  REQUIRE(wait4(child, &status, 0, &usage) == child);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6;
  };
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
          seconds(usage.ru_utime) + seconds(usage.ru_stime), static_cast<double>(usage.ru_maxrss) / 1024,
          read_all(folder / "stdout.txt"), read_all(folder / "stderr.txt")};
}

inline Ended run_program(const std::string& program, const std::filesystem::path& folder,
                         const std::vector<std::string>& arguments) {
  return wait_for(start_program(program, folder, arguments), folder);
}
