#pragma once

#include <functional>
#include <vector>

namespace CLI {
class App;
}

namespace sheen::tools {

/// Runs a parsed command; returns an exit code.
using Action = std::function<int()>;

/// One command of the program: the parser and the help are made from it.
struct Command {
  const char* name;
  const char* summary;
  const char* example;                       ///< without the program's name; may be null where there are commands under it
  std::function<Action(CLI::App&)> declare;  ///< adds the flags and returns what runs the command with what they were given
  std::vector<Command> commands = {};        ///< commands under this one
};

/// Every command, in the order in which help shows them.
std::vector<Command> commands();

}  // namespace sheen::tools
