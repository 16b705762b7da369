#include "conformance/report_function.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <tuple>

#include "conformance/report.h"
#include "conformance/shading_words.h"

namespace sheen::conformance {
namespace {

using renderer::Formulation;
using renderer::Precision;

/// One function in one form and precision, over all its arguments.
struct Tally {
  std::int64_t nan_samples = 0, infinite_samples = 0;
  double largest_error = 0;
  std::string largest_at;
  const FunctionFindings* dense = nullptr;

  void add(const FunctionFindings& findings) {
    nan_samples += findings.nan_samples;
    infinite_samples += findings.infinite_samples;
    if (findings.largest_error > largest_error) {
      largest_error = findings.largest_error;
      largest_at = findings.largest_at;
    }
    dense = findings.map.empty() ? dense : &findings;
  }
};

using Tallies = std::map<std::tuple<std::string, Precision, Formulation>, Tally>;

std::string map_image(const FunctionFindings& findings, const std::string& caption) {
  return "<figure><img class=map alt=\"" + escape_html(findings.map_axes) + "\" src=\"data:image/png;base64," + base64(findings.map) +
         "\"><figcaption>" + escape_html(caption) + "</figcaption></figure>";
}

std::string error_text(const Tally& tally) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.2g", tally.largest_error);
  return "<span title=\"" + escape_html(tally.largest_at) + "\">" + text.data() + "</span>";
}

std::string cells(const Tallies& tallies, const std::string& function, Precision precision, Formulation formulation) {
  const auto found = tallies.find({function, precision, formulation});
  if (found == tallies.end()) {
    return "<td colspan=4></td>";
  }
  const Tally& tally = found->second;
  const auto count = [](std::int64_t n) { return n == 0 ? std::string("<td>0</td>") : "<td><b>" + std::to_string(n) + "</b></td>"; };
  return count(tally.nan_samples) + count(tally.infinite_samples) + "<td>" + error_text(tally) + "</td><td>" +
         (tally.dense == nullptr ? "" : map_image(*tally.dense, tally.dense->map_axes)) + "</td>";
}

}  // namespace

std::string function_pictures(const FunctionFindings& findings) {
  const std::string map = findings.map.empty() ? "" : map_image(findings, findings.map_axes);
  return "<div class=pictures>" + map + "<figure>" + findings.plots + "<figcaption>" + findings.legend + "</figcaption></figure></div>";
}

std::string formulation_table(const RunRecord& record) {
  Tallies tallies;
  std::vector<std::pair<std::string, Precision>> printed;
  for (const CaseResult& one : record.cases) {
    if (!one.findings) {
      continue;
    }
    const FunctionCase& tested = one.findings->tested;
    tallies[{tested.function, tested.precision, tested.formulation}].add(*one.findings);
    const std::pair<std::string, Precision> row{tested.function, tested.precision};
    if (tested.formulation == Formulation::Literal && std::find(printed.begin(), printed.end(), row) == printed.end()) {
      printed.push_back(row);
    }
  }
  if (printed.empty()) {
    return "";
  }
  const std::string columns = "<th>NaN</th><th>Inf</th><th>largest error</th><th></th>";
  std::string html =
      "<section><h2>Where the printed form fails</h2><p>Samples that came out NaN or Inf, and the largest error of the others relative to "
      "max(|value|, 1e-3), against the function in exact arithmetic. The pictures run over roughness, to the right, and the cosine or "
      "angle, "
      "upward: dark blue 1e-7, green 1e-4, yellow 1e-1, magenta NaN, white Inf. Each function's largest error says where it lies when "
      "pointed "
      "at.</p><div class=wide><table class=formulation><tr><th></th>"
      "<th></th><th colspan=4>literal: as printed</th><th colspan=4>stable</th></tr><tr><th>function</th><th>precision</th>" +
      columns + columns + "</tr>";
  for (const auto& [function, precision] : printed) {
    html += "<tr><td>" + escape_html(function) + "</td><td>" + to_string(precision) + "</td>" +
            cells(tallies, function, precision, Formulation::Literal) + cells(tallies, function, precision, Formulation::Stable) + "</tr>";
  }
  return html + "</table></div></section>\n";
}

}  // namespace sheen::conformance
