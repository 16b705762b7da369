#include "tools/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace sheen::tools {
namespace {

constexpr auto redraw = std::chrono::milliseconds(100);  // as often as an eye can follow
constexpr auto plain_line = std::chrono::seconds(5);     // a log must not fill with them

std::string clock_text(double seconds) {
  if (!std::isfinite(seconds)) {
    return "--:--";
  }
  const auto whole = static_cast<std::int64_t>(seconds + 0.5);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace

Progress::Progress(std::string what, std::string unit, std::int64_t total)
    : what_(std::move(what)),
      unit_(std::move(unit)),
      total_(std::max<std::int64_t>(total, 1)),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      last_(start_) {}

Progress::~Progress() {
  clear();
}

void Progress::update(std::int64_t count) {
  const std::lock_guard lock(mutex_);
  if (count <= count_) {
    return;
  }
  count_ = std::min(count, total_);
  const auto now = Clock::now();
  if (now - last_ < (terminal_ ? Clock::duration(redraw) : Clock::duration(plain_line))) {
    return;
  }
  last_ = now;
  draw(now);
}

void Progress::message(const std::string& line) {
  const std::lock_guard lock(mutex_);
  clear();
  fmt::print(stderr, "{}\n", line);
}

void Progress::draw(Clock::time_point now) {
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double share = static_cast<double>(count_) / static_cast<double>(total_);
  const double rate = static_cast<double>(count_) / std::max(seconds, 1e-9);
  const double left = static_cast<double>(total_ - count_) / std::max(rate, 1e-9);
  const std::string figures =
      fmt::format("{}/{} {}, {:.{}f}/s, {} left", count_, total_, unit_, rate, rate < 10.0 ? 1 : 0, clock_text(left));
  if (terminal_) {
    constexpr int width = 28;
    const int filled = static_cast<int>(share * width);
    fmt::print(stderr, "\r{} [{:#<{}}{:.<{}}] {}\x1b[K", what_, "", filled, "", width - filled, figures);
    drawn_ = true;
  } else {
    fmt::print(stderr, "{}: {:.0f}%, {}\n", what_, 100.0 * share, figures);
  }
  std::fflush(stderr);
}

void Progress::clear() {
  if (!drawn_) {
    return;
  }
  fmt::print(stderr, "\r\x1b[K");
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace sheen::tools
