#include "apps/common/child.h"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

namespace manzana::apps {
namespace {

volatile std::sig_atomic_t interrupted = 0;

}  // namespace

void throw_if_interrupted() {
  if (interrupted != 0) throw Interrupted();
}

namespace {

/// A child that is ended and waited for whatever happens.
class Child {
 public:
  explicit Child(const std::vector<std::string>& command) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) throw std::runtime_error(std::string("no pipe: ") + std::strerror(errno));
    id_ = fork();
    if (id_ == 0) run(command, ends);
    close(ends[1]);
    out_ = ends[0];
    if (id_ < 0) throw std::runtime_error(std::string("no process: ") + std::strerror(errno));
  }
  ~Child() {
    close(out_);
    if (id_ > 0) {
      kill(id_, SIGTERM);
      wait();
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// False at the end of what it says.
  bool read_more(std::string& text) const {
    std::array<char, 4096> bytes{};
    ssize_t n = 0;
    do {
      throw_if_interrupted();
      n = read(out_, bytes.data(), bytes.size());
    } while (n < 0 && errno == EINTR);
    if (n > 0) text.append(bytes.data(), static_cast<std::size_t>(n));
    return n > 0;
  }

  int wait() {
    int status = 0;
    while (waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    id_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

 private:
  [[noreturn]] static void run(const std::vector<std::string>& command, const std::array<int, 2>& ends) {
    std::vector<char*> argv;
    for (const std::string& word : command) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    dup2(ends[1], STDOUT_FILENO);
    close(ends[0]);
    close(ends[1]);
    execvp(argv[0], argv.data());
    _exit(127);
  }

  pid_t id_ = -1;
  int out_ = -1;
};

}  // namespace

void watch_for_interrupts() {
  struct sigaction action {};
  action.sa_handler = [](int) { interrupted = 1; };
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
}

int run_child(const std::vector<std::string>& command, const std::function<void(const std::string&)>& line) {
  Child child(command);
  std::string text;
  while (child.read_more(text)) {
    for (std::size_t end = 0; (end = text.find('\n')) != std::string::npos; text.erase(0, end + 1))
      line(text.substr(0, end));
  }
  const int code = child.wait();
  if (interrupted != 0) throw Interrupted();
  return code;
}

void end_with_parent() { prctl(PR_SET_PDEATHSIG, SIGTERM); }

}  // namespace manzana::apps
