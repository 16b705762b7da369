#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

namespace sheen::conformance {

using Deadline = std::chrono::steady_clock::time_point;

/// The deadline `seconds` from now.
Deadline deadline_in(double seconds);

/// A program run as a child, in a process group of its own, spoken to by lines on its standard input and output. What it writes to standard
/// error is read along and its end kept. Ended, with all it started in its group, when this object goes.
class ChildProcess {
 public:
  /// @param command  program (looked up in PATH) and its arguments
  /// Throws std::runtime_error saying why when it cannot be started.
  explicit ChildProcess(const std::vector<std::string>& command);
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Writes the line and a line end. False when the child does not take it in time or has closed its input.
  bool write_line(const std::string& line, Deadline deadline);

  enum class ReadStatus { Line, Closed, Timeout, TooLong };
  /// The next line of its standard output, without the line end. Closed: it has ended its output. TooLong: over 1 MiB without an end.
  ReadStatus read_line(std::string& line, Deadline deadline);

  /// Closes its input, gives it `seconds` to end, then kills its group. Says how it ended: "exited with status 3", "was killed by signal 11
  /// (Segmentation fault)", "did not end by itself".
  std::string finish(double seconds);

  /// The last 4 KiB of its standard error, for messages.
  const std::string& last_words() const { return error_tail_; }

 private:
  void drain_error();
  bool wait_exited(Deadline deadline) const;

  pid_t pid_ = -1;
  int in_ = -1;
  int out_ = -1;
  int err_ = -1;
  std::string pending_;
  std::string error_tail_;
  std::string ending_;
};

/// Splits a command into words at spaces; '...' and "..." hold spaces, a backslash outside '...' takes the next character as it is.
/// Throws std::invalid_argument when a quote is not closed or there is no word.
std::vector<std::string> split_command(const std::string& command);

}  // namespace sheen::conformance
