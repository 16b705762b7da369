#include "conformance/child_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <thread>
#include <utility>

#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace sheen::conformance {
namespace {

constexpr std::size_t longest_line = 1 << 20;
constexpr std::size_t tail_length = 4096;

class Pipe {
 public:
  Pipe() {
    if (pipe2(ends_.data(), O_CLOEXEC) != 0) {
      throw std::runtime_error(std::string("no pipe: ") + std::strerror(errno));
    }
  }
  ~Pipe() {
    for (const int end : ends_) {
      if (end >= 0) {
        close(end);
      }
    }
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int end(std::size_t which) const { return ends_.at(which); }
  int release(std::size_t which) { return std::exchange(ends_.at(which), -1); }

 private:
  std::array<int, 2> ends_{-1, -1};
};

/// posix_spawn's two objects, with their release.
class SpawnPlan {
 public:
  SpawnPlan(int in, int out, int err) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_adddup2(&actions_, in, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, out, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions_, err, STDERR_FILENO);
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    posix_spawnattr_setpgroup(&attributes_, 0);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes_, &none);
    sigset_t pipe_signal;
    sigemptyset(&pipe_signal);
    sigaddset(&pipe_signal, SIGPIPE);
    posix_spawnattr_setsigdefault(&attributes_, &pipe_signal);
  }
  ~SpawnPlan() {
    posix_spawn_file_actions_destroy(&actions_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;

  int spawn(pid_t& pid, const std::vector<std::string>& command) {
    std::vector<std::string> words = command;
    std::vector<char*> arguments;
    for (std::string& word : words) {
      arguments.push_back(word.data());
    }
    arguments.push_back(nullptr);
    return posix_spawnp(&pid, arguments.front(), &actions_, &attributes_, arguments.data(), environ);
  }

 private:
  posix_spawn_file_actions_t actions_{};
  posix_spawnattr_t attributes_{};
};

/// Writing to a pipe nobody reads raises SIGPIPE; this thread takes it as an error code instead.
class SigpipeBlocked {
 public:
  SigpipeBlocked() {
    sigemptyset(&set_);
    sigaddset(&set_, SIGPIPE);
    sigset_t pending;
    sigpending(&pending);
    was_pending_ = sigismember(&pending, SIGPIPE) == 1;
    pthread_sigmask(SIG_BLOCK, &set_, &before_);
  }
  ~SigpipeBlocked() {
    if (!was_pending_) {
      const timespec now{0, 0};
      while (sigtimedwait(&set_, nullptr, &now) == -1 && errno == EINTR) {
      }
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
  SigpipeBlocked(const SigpipeBlocked&) = delete;
  SigpipeBlocked& operator=(const SigpipeBlocked&) = delete;

 private:
  sigset_t set_{};
  sigset_t before_{};
  bool was_pending_ = false;
};

int milliseconds_until(Deadline deadline) {
  const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now()).count();
  return static_cast<int>(std::clamp<long long>(left + 1, 0, 60 * 60 * 1000));
}

void close_fd(int& fd) {
  if (fd >= 0) {
    close(std::exchange(fd, -1));
  }
}

std::string describe_exit(int status) {
  if (WIFEXITED(status)) {
    return "exited with status " + std::to_string(WEXITSTATUS(status));
  }
  if (WIFSIGNALED(status)) {
    const int number = WTERMSIG(status);
    return "was killed by signal " + std::to_string(number) + " (" + strsignal(number) + ")";
  }
  return "ended";
}

}  // namespace

Deadline deadline_in(double seconds) {
  return std::chrono::steady_clock::now() +
         std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(seconds));
}

ChildProcess::ChildProcess(const std::vector<std::string>& command) {
  if (command.empty()) {
    throw std::runtime_error("no command");
  }
  Pipe in;
  Pipe out;
  Pipe err;
  SpawnPlan plan(in.end(0), out.end(1), err.end(1));
  const int error = plan.spawn(pid_, command);
  if (error != 0) {
    throw std::runtime_error("'" + command.front() + "' cannot be started: " + std::strerror(error));
  }
  in_ = in.release(1);
  out_ = out.release(0);
  err_ = err.release(0);
  for (const int fd : {in_, out_, err_}) {
    fcntl(fd, F_SETFL, fcntl(fd, F_GETFL) | O_NONBLOCK);
  }
}

ChildProcess::~ChildProcess() {
  try {
    finish(0);
  } catch (const std::exception&) {  // a destructor has nobody to tell
  }
  close_fd(out_);
  close_fd(err_);
}

bool ChildProcess::write_line(const std::string& line, Deadline deadline) {
  const SigpipeBlocked blocked;
  const std::string text = line + "\n";
  std::size_t done = 0;
  while (done < text.size()) {
    if (in_ < 0) {
      return false;
    }
    const ssize_t wrote = write(in_, text.data() + done, text.size() - done);
    if (wrote > 0) {
      done += static_cast<std::size_t>(wrote);
      continue;
    }
    if (wrote < 0 && errno != EAGAIN && errno != EINTR) {
      return false;
    }
    drain_error();
    pollfd wait[2] = {{in_, POLLOUT, 0}, {err_, POLLIN, 0}};
    if (std::chrono::steady_clock::now() >= deadline) {
      return false;
    }
    poll(wait, 2, milliseconds_until(deadline));
  }
  return true;
}

ChildProcess::ReadStatus ChildProcess::read_line(std::string& line, Deadline deadline) {
  while (true) {
    const std::size_t end = pending_.find('\n');
    if (end != std::string::npos) {
      line = pending_.substr(0, end);
      if (!line.empty() && line.back() == '\r') {
        line.pop_back();
      }
      pending_.erase(0, end + 1);
      return ReadStatus::Line;
    }
    if (pending_.size() > longest_line) {
      return ReadStatus::TooLong;
    }
    drain_error();
    std::array<char, 65536> buffer;
    const ssize_t got = read(out_, buffer.data(), buffer.size());
    if (got > 0) {
      pending_.append(buffer.data(), static_cast<std::size_t>(got));
      continue;
    }
    if (got == 0) {
      return ReadStatus::Closed;
    }
    if (errno != EAGAIN && errno != EINTR) {
      return ReadStatus::Closed;
    }
    if (std::chrono::steady_clock::now() >= deadline) {
      return ReadStatus::Timeout;
    }
    pollfd wait[2] = {{out_, POLLIN, 0}, {err_, POLLIN, 0}};
    poll(wait, 2, milliseconds_until(deadline));
  }
}

void ChildProcess::drain_error() {
  std::array<char, 4096> buffer;
  while (err_ >= 0) {
    const ssize_t got = read(err_, buffer.data(), buffer.size());
    if (got == 0) {
      close_fd(err_);
    }
    if (got <= 0) {
      return;
    }
    error_tail_.append(buffer.data(), static_cast<std::size_t>(got));
    if (error_tail_.size() > tail_length) {
      error_tail_.erase(0, error_tail_.size() - tail_length);
    }
  }
}

bool ChildProcess::wait_exited(Deadline deadline) const {
  while (true) {
    siginfo_t info{};
    // WNOWAIT leaves the child unreaped, so that its process group's number cannot pass to a stranger before the group is killed.
    if (waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == pid_) {
      return true;
    }
    if (std::chrono::steady_clock::now() >= deadline) {
      return false;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

std::string ChildProcess::finish(double seconds) {
  if (pid_ < 0) {
    return ending_;
  }
  close_fd(in_);
  const bool by_itself = wait_exited(deadline_in(seconds));
  kill(-pid_, SIGKILL);
  int status = 0;
  while (waitpid(pid_, &status, 0) == -1 && errno == EINTR) {
  }
  pid_ = -1;
  drain_error();
  ending_ = by_itself ? describe_exit(status) : "did not end by itself";
  return ending_;
}

std::vector<std::string> split_command(const std::string& command) {
  std::vector<std::string> words;
  std::string word;
  bool in_word = false;
  char quote = 0;
  for (std::size_t i = 0; i < command.size(); ++i) {
    const char c = command[i];
    if (quote == 0 && (c == ' ' || c == '\t' || c == '\n')) {
      if (in_word) {
        words.push_back(std::exchange(word, ""));
      }
      in_word = false;
      continue;
    }
    in_word = true;
    if (c == '\\' && quote != '\'' && i + 1 < command.size()) {
      word += command[++i];
    } else if (quote == 0 && (c == '\'' || c == '"')) {
      quote = c;
    } else if (c == quote) {
      quote = 0;
    } else {
      word += c;
    }
  }
  if (quote != 0) {
    throw std::invalid_argument("viewer command: a quote is not closed: " + command);
  }
  if (in_word) {
    words.push_back(word);
  }
  if (words.empty()) {
    throw std::invalid_argument("viewer command: no word in it");
  }
  return words;
}

}  // namespace sheen::conformance
