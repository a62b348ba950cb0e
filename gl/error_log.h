#pragma once
/// What the driver complains of, by KHR_debug. For tests and debug builds: synchronous, so a little slower.
///   ErrorLog log;                    // with the context current; while it lives, messages are collected
///   ...; assert(log.messages().empty());
#include <memory>
#include <string>
#include <vector>

namespace manzana::gl {

class ErrorLog {
 public:
  ErrorLog();
  ~ErrorLog();
  ErrorLog(const ErrorLog&) = delete;
  ErrorLog& operator=(const ErrorLog&) = delete;
  /// Errors, undefined behaviour and everything of high severity, oldest first; also what glGetError still holds.
  const std::vector<std::string>& messages();

 private:
  std::unique_ptr<std::vector<std::string>> messages_;
};

}  // namespace manzana::gl
