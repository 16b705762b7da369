#include "tools/parser.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>
#include <string>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "conformance/case.h"
#include "conformance/joined_runs.h"
#include "conformance/json_text.h"
#include "conformance/run.h"
#include "gles/context.h"
#include "image/io.h"
#include "scene/scene.h"
#include "tools/commands.h"
#include "tools/errors.h"

namespace sheen::tools {
namespace {

constexpr const char* exit_codes =
    "Exit codes: 0 done, all passed; 1 ran, something failed; 2 usage; 3 a file that cannot be read, written or used;\n"
    "            4 this machine lacks something; 5 internal error.";

/// Says what went wrong: on stderr, and with --json on stdout as an object.
int fail(ExitCode code, const std::string& message, bool json) {
  fmt::print(stderr, "sheen-cts: {}\n", message);
  if (json) {
    std::cout << conformance::json_text(nlohmann::ordered_json{{"error", message}, {"exit_code", static_cast<int>(code)}}, 2) << '\n';
  }
  return code;
}

/// Runs the action; what it throws becomes an exit code.
int guarded(const Action& action, bool json) {
  try {
    const int code = action();
    std::cout.flush();
    return std::cout ? code : fail(bad_input, "stdout: cannot be written", false);
  } catch (const UsageError& error) {
    return fail(usage, error.what(), json);
  } catch (const std::invalid_argument& error) {
    return fail(usage, error.what(), json);  // a name that the command line gave and the library does not know
  } catch (const InputError& error) {
    return fail(bad_input, error.what(), json);
  } catch (const scene::Error& error) {
    return fail(bad_input, error.what(), json);
  } catch (const image::Error& error) {
    return fail(bad_input, error.what(), json);
  } catch (const conformance::SuiteError& error) {
    return fail(bad_input, error.what(), json);
  } catch (const conformance::ResultsError& error) {
    return fail(bad_input, error.what(), json);
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(bad_input, error.what(), json);
  } catch (const gles::Unavailable& error) {
    return fail(machine_lacks, error.what(), json);
  } catch (const gles::Error& error) {
    return fail(machine_lacks, error.what(), json);
  } catch (const conformance::ViewerUnavailable& error) {
    return fail(machine_lacks, error.what(), json);
  } catch (const std::exception& error) {
    return fail(internal_error, std::string("internal error: ") + error.what(), json);
  } catch (...) {
    return fail(internal_error, "internal error", json);
  }
}

/// Adds a command and those under it; the one that is named sets `chosen`.
void add_command(CLI::App& parent, const Command& command, Action& chosen) {
  CLI::App* app = parent.add_subcommand(command.name, command.summary);
  app->option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::Throw);
  if (command.example != nullptr) {
    app->footer(std::string("Example:\n  sheen-cts ") + command.example);
  }
  if (!command.commands.empty()) {
    for (const Command& inner : command.commands) {
      add_command(*app, inner, chosen);
    }
    return;
  }
  const Action action = command.declare(*app);
  app->callback([&chosen, action] { chosen = action; });
}

}  // namespace

int run_command_line(int argc, const char* const* argv) {
  const bool json = std::any_of(argv, argv + argc, [](const char* argument) { return std::string_view(argument) == "--json"; });
  CLI::App app("Conformance suite for sheen, clearcoat over sheen and albedo scaling in glTF viewers.", "sheen-cts");
  Action chosen;
  try {
    app.set_version_flag("--version", SHEEN_CTS_VERSION);
    app.footer(exit_codes);
    for (const Command& command : commands()) {
      add_command(app, command, chosen);
    }
    app.parse(argc, argv);
    if (!chosen) {
      throw UsageError("a command is needed; run with --help for those there are");
    }
  } catch (const CLI::Success& request) {
    return app.exit(request);  // --help, --version
  } catch (const CLI::ParseError& error) {
    return fail(usage, std::string(error.what()) + "\nRun with --help for the commands and flags.", json);
  } catch (const UsageError& error) {
    return fail(usage, error.what(), json);
  } catch (const std::exception& error) {
    return fail(internal_error, error.what(), json);
  }
  return guarded(chosen, json);
}

}  // namespace sheen::tools
