#pragma once

#include <string>

#include "conformance/function_findings.h"
#include "conformance/results.h"

namespace sheen::conformance {

/// Error and bound of a function's case against each parameter, and of dense arguments the error over the first two: HTML for its card.
std::string function_pictures(const FunctionFindings& findings);

/// What the specifications' printed code loses where the stable form does not, function by function and precision by precision; empty for
/// a run without such cases.
std::string formulation_table(const RunRecord& record);

}  // namespace sheen::conformance
