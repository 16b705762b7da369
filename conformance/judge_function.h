#pragma once

#include <filesystem>
#include <functional>

#include "conformance/function_case.h"
#include "conformance/judge.h"
#include "conformance/viewer.h"

namespace sheen::conformance {

/// Has a viewer evaluate a function and holds what it gives to what is promised. Leaves the arguments and the result beside the other
/// pictures of the run. Never throws: what goes wrong is the result's message.
CaseResult judge_function(const FunctionCase& one, const std::function<Answer(const FunctionRequest&)>& evaluate, const Hello& hello,
                          const std::filesystem::path& images);

}  // namespace sheen::conformance
