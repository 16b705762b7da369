#pragma once

#include <stdexcept>

namespace sheen::tools {

/// What the program's exit code says.
enum ExitCode : int {
  done = 0,            ///< done, all passed
  failed = 1,          ///< ran, and something failed
  usage = 2,           ///< the command line is wrong
  bad_input = 3,       ///< a file that cannot be read, written or used; the message names file, element and rule
  machine_lacks = 4,   ///< no GL context, a viewer that did not start
  internal_error = 5,  ///< a fault of this program
};

/// A command line that parses but asks for what cannot be: exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A file that cannot be used as asked: exit code 3. The message names the file and the rule.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace sheen::tools
