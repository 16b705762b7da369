#pragma once

#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace sheen::tools {

/// Shows long work on stderr: on a terminal a bar with count, rate and time left, redrawn in place; elsewhere a plain line now and then.
/// Work that ends within a second shows nothing but on a terminal. Safe to call from many threads.
class Progress {
 public:
  /// @param what   what is being done: "golden"
  /// @param unit   what is counted: "pixels"
  /// @param total  the count at the end, > 0
  Progress(std::string what, std::string unit, std::int64_t total);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// The count done so far; a smaller one than before is ignored.
  void update(std::int64_t count);

  /// Prints a line of its own, above the bar.
  void message(const std::string& line);

 private:
  using Clock = std::chrono::steady_clock;

  void draw(Clock::time_point now);
  void clear();

  std::string what_;
  std::string unit_;
  std::int64_t total_;
  std::int64_t count_ = 0;
  bool terminal_;
  bool drawn_ = false;
  Clock::time_point start_;
  Clock::time_point last_;
  std::mutex mutex_;
};

}  // namespace sheen::tools
