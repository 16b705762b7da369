#pragma once

#include <string>

#include "conformance/joined_runs.h"

namespace sheen::conformance {

/// The page of joined runs: a table of the drivers, then one of the cases with a column a driver. One file without references to others.
std::string joined_html(const JoinedRuns& joined);

}  // namespace sheen::conformance
