#include "conformance/results.h"

#include <nlohmann/json.hpp>

#include "conformance/function_findings.h"
#include "conformance/json_text.h"
#include "conformance/shading_words.h"

namespace sheen::conformance {
namespace {

using nlohmann::json;

json case_json(const CaseResult& one) {
  json made = {{"name", one.name},       {"status", to_string(one.status)}, {"identified", text_or_null(one.identified)},
               {"seconds", one.seconds}, {"message", one.message},          {"worst_pixel", nullptr}};
  // A picture of another size was looked at, but nothing of it could be measured.
  const bool measured = one.verdict && (one.verdict->compared_pixels > 0 || one.verdict->nonfinite_pixels > 0);
  const Verdict* verdict = measured ? &*one.verdict : nullptr;
  const auto figure = [verdict](auto Verdict::*member) { return verdict == nullptr ? json(nullptr) : json(verdict->*member); };
  // Where every pixel was left out no error could be measured, but what was left out can be told.
  const bool counted = measured || (one.verdict && one.verdict->excluded_pixels > 0);
  const auto pixels = [&one, counted](auto Verdict::*member) { return counted ? json(*one.verdict.*member) : json(nullptr); };
  made["max_abs"] = figure(&Verdict::max_abs);
  made["max_rel"] = figure(&Verdict::max_rel);
  made["p99_rel"] = figure(&Verdict::p99_rel);
  made["bound_ratio"] = figure(&Verdict::bound_ratio);
  made["median_bound"] = figure(&Verdict::median_bound);
  made["compared_pixels"] = pixels(&Verdict::compared_pixels);
  made["excluded_pixels"] = pixels(&Verdict::excluded_pixels);
  made["excluded_by"] = nullptr;
  if (counted) {
    const auto& by = one.verdict->excluded_by;
    made["excluded_by"] = {{"edges", by[1]}, {"masks", by[2]}, {"textures", by[3]}, {"unpromised", by[4]}};
  }
  made["vague_pixels"] = figure(&Verdict::vague_pixels);
  made["negative_pixels"] = pixels(&Verdict::negative_pixels);
  made["nonfinite_pixels"] = figure(&Verdict::nonfinite_pixels);
  if (one.findings) {
    const FunctionCase& tested = one.findings->tested;
    made["function"] = {{"name", tested.function},
                        {"precision", to_string(tested.precision)},
                        {"formulation", to_string(tested.formulation)},
                        {"arguments", to_string(tested.arguments)},
                        {"nan_samples", one.findings->nan_samples},
                        {"infinite_samples", one.findings->infinite_samples},
                        {"largest_error", one.findings->largest_error}};
  }
  if (verdict != nullptr && verdict->worst_x >= 0) {
    made["worst_pixel"] = {verdict->worst_x, verdict->worst_y};
  }
  return made;
}

}  // namespace

RunResult summarize(const RunRecord& record, bool may_be_empty) {
  RunResult result;
  result.seconds = record.seconds;
  for (const CaseResult& one : record.cases) {
    switch (one.status) {
      case Status::Pass:
        ++result.pass;
        break;
      case Status::Approximation:
        ++result.approximation;
        break;
      case Status::Fail:
        ++result.fail;
        break;
      case Status::Unsupported:
        ++result.unsupported;
        break;
      case Status::Crash:
        ++result.crash;
        break;
      case Status::Timeout:
        ++result.timeout;
        break;
      case Status::Invalid:
        ++result.invalid;
        break;
    }
  }
  const bool none_bad = result.fail + result.crash + result.timeout + result.invalid == 0 && !(record.strict && result.approximation > 0);
  const bool some_good = result.pass + result.approximation > 0 || (record.cases.empty() && may_be_empty);
  result.ok = none_bad && some_good;
  result.results_json = results_json(record);
  return result;
}

std::string results_json(const RunRecord& record) {
  json summary = json::object();
  for (const Status status : statuses) {
    summary[to_string(status)] = 0;
  }
  json cases = json::array();
  for (const CaseResult& one : record.cases) {
    summary[to_string(one.status)] = summary[to_string(one.status)].get<int>() + 1;
    cases.push_back(case_json(one));
  }
  const Hello& viewer = record.viewer;
  const json root = {{"suite", record.suite},
                     {"viewer", {{"name", viewer.name}, {"version", viewer.version}}},
                     {"context",
                      {{"renderer", text_or_null(viewer.renderer)},
                       {"version", text_or_null(viewer.context_version)},
                       {"mediump_bits", viewer.mediump_bits ? json(*viewer.mediump_bits) : json(nullptr)},
                       {"subpixel_bits", viewer.subpixel_bits}}},
                     {"summary", summary},
                     {"seconds", record.seconds},
                     {"cases", cases}};
  return json_text(root, 1) + "\n";
}

}  // namespace sheen::conformance
