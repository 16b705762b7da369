// Has the suites kill every mutant. Arguments: the run driver, the mutant viewer, a folder to work in, and perhaps names of mutants,
// without which all are run and the folder is emptied first. Exit codes: 0 all killed and the control not, 1 otherwise, 2 usage, 5
// internal.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <mutex>
#include <thread>

#include "conformance/mutants/hunt.h"

namespace {

using namespace sheen::conformance;

/// The message's first clause: what the picture is off by.
std::string first_clause(const std::string& message) {
  return message.substr(0, message.find(';'));
}

void print(const Mutant& mutant, const Fate& fate) {
  if (fate.kill) {
    std::printf("killed    %s by %s %s: %s\n", mutant.name.c_str(), fate.kill->suite.c_str(), fate.kill->name.c_str(),
                first_clause(fate.kill->message).c_str());
  } else if (fate.error.empty()) {
    std::printf("SURVIVED  %s: %s\n", mutant.name.c_str(), mutant.why.c_str());
  } else {
    std::printf("ERROR     %s: the harness cannot judge it: %s\n", mutant.name.c_str(), fate.error.c_str());
  }
  std::fflush(stdout);
}

/// The fates of all, a few at a time: viewer and judge are processes that wait for each other.
std::vector<Fate> hunt_all(const Hunt& how, const std::vector<Mutant>& chosen) {
  std::vector<Fate> fates(chosen.size());
  std::atomic<std::size_t> next{0};
  std::mutex printing;
  const auto work = [&] {
    for (std::size_t i = next++; i < chosen.size(); i = next++) {
      try {
        fates[i] = hunt(how, chosen[i]);
      } catch (const std::exception& error) {
        fates[i].error = error.what();
      }
      const std::lock_guard lock(printing);
      print(chosen[i], fates[i]);
    }
  };
  std::vector<std::thread> threads;
  for (unsigned i = 0; i < std::max(std::thread::hardware_concurrency(), 1U); ++i) {
    threads.emplace_back(work);
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
  return fates;
}

int run_all(const Hunt& how, const std::vector<Mutant>& chosen) {
  std::vector<Kill> kills;
  for (const Fate& fate : hunt_all(how, chosen)) {
    if (fate.kill) {
      kills.push_back(*fate.kill);
    }
  }
  const Control of_none = control(how, kills);
  for (const Kill& kill : of_none.killed) {
    std::printf("CONTROL   killed by %s %s: %s\n", kill.suite.c_str(), kill.name.c_str(), kill.message.c_str());
  }
  if (!of_none.error.empty()) {
    std::printf("CONTROL   cannot be judged: %s\n", of_none.error.c_str());
  }
  std::printf("control: killed %zu\nkilled %zu of %zu\n", of_none.killed.size(), kills.size(), chosen.size());
  return kills.size() == chosen.size() && of_none.killed.empty() && of_none.error.empty() ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::fputs("usage: sheen-cts-run-mutants RUN_DRIVER MUTANT_VIEWER FOLDER [MUTANT...]\n", stderr);
    return 2;
  }
  try {
    const Hunt how{argv[1], argv[2], argv[3]};
    std::vector<Mutant> chosen;
    for (int i = 4; i < argc; ++i) {
      chosen.push_back(find_mutant(argv[i]));
    }
    if (chosen.empty()) {
      chosen = mutants();
      std::filesystem::remove_all(how.folder);
    }
    std::filesystem::create_directories(how.folder);
    return run_all(how, chosen);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 5;
  }
}
