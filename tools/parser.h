#pragma once

namespace sheen::tools {

/// Parses the command line by the table of commands and runs the command it names. Never throws: prints what went wrong on stderr (with
/// --json also as an object on stdout) and returns one of ExitCode.
int run_command_line(int argc, const char* const* argv);

}  // namespace sheen::tools
