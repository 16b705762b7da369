#include "conformance/joined_runs.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

#include "conformance/json_text.h"
#include "conformance/nearest_rank.h"
#include "scene/scene.h"

namespace sheen::conformance {
namespace {

using nlohmann::json;

/// An object of a results.json that knows where it stands. What it hands out is of the type asked for.
class Member {
 public:
  Member(const std::string& file, std::string element, const json& value) : file_(file), element_(std::move(element)), value_(value) {
    if (!value.is_object()) {
      fail("must be an object");
    }
  }

  std::string string(const char* key) const {
    const json& found = require(key);
    if (!found.is_string()) {
      fail(std::string("'") + key + "' must be a text");
    }
    return found.get<std::string>();
  }
  /// What may be null is empty then.
  std::string string_or_empty(const char* key) const { return require(key).is_null() ? "" : string(key); }
  /// Not negative.
  std::optional<double> number(const char* key) const {
    const json& found = require(key);
    if (found.is_null()) {
      return std::nullopt;
    }
    if (!found.is_number() || !(found.get<double>() >= 0)) {
      fail(std::string("'") + key + "' must be a number of at least 0, or null");
    }
    return found.get<double>();
  }
  template <class Integer>
  std::optional<Integer> count(const char* key) const {
    const json& found = require(key);
    if (found.is_null()) {
      return std::nullopt;
    }
    if (!found.is_number_unsigned() || found.get<std::uint64_t>() > static_cast<std::uint64_t>(std::numeric_limits<Integer>::max())) {
      fail(std::string("'") + key + "' must be a whole number of at least 0, or null");
    }
    return found.get<Integer>();
  }
  Member object(const char* key) const { return {file_, key, require(key)}; }
  const json& array(const char* key) const {
    const json& found = require(key);
    if (!found.is_array()) {
      fail(std::string("'") + key + "' must be an array");
    }
    return found;
  }
  [[noreturn]] void fail(const std::string& rule) const { throw ResultsError(file_, element_, rule); }

 private:
  const json& require(const char* key) const {
    const auto found = value_.find(key);
    if (found == value_.end()) {
      fail(std::string("needs '") + key + "'");
    }
    return *found;
  }

  const std::string& file_;
  std::string element_;
  const json& value_;
};

Status parse_status(const Member& of) {
  const std::string word = of.string("status");
  const auto found = std::find_if(statuses.begin(), statuses.end(), [&word](Status status) { return to_string(status) == word; });
  if (found == statuses.end()) {
    of.fail("unknown status '" + scene::legible(word) + "'");
  }
  return *found;
}

json parse_file(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in) {
    throw ResultsError(file, "the file", "cannot be read; a run writes it into its report's folder");
  }
  json root = json::parse(text, nullptr, false);
  if (root.is_discarded()) {
    throw ResultsError(file, "the file", "is no JSON (RFC 8259)");
  }
  return root;
}

DriverColumn read_column(const Member& root, const RunFolder& run) {
  const Member context = root.object("context");
  DriverColumn column;
  column.name = run.driver;
  column.renderer = context.string_or_empty("renderer");
  column.version = context.string_or_empty("version");
  column.subpixel_bits = context.count<int>("subpixel_bits");
  column.mediump_bits = context.count<int>("mediump_bits");
  return column;
}

bool same_context(const DriverColumn& a, const DriverColumn& b) {
  return a.renderer == b.renderer && a.version == b.version && a.subpixel_bits == b.subpixel_bits && a.mediump_bits == b.mediump_bits;
}

CaseFigures read_figures(const Member& one) {
  CaseFigures figures;
  figures.status = parse_status(one);
  figures.bound_ratio = one.number("bound_ratio");
  figures.p99_rel = one.number("p99_rel");
  figures.median_bound = one.number("median_bound");
  figures.compared_pixels = one.count<std::int64_t>("compared_pixels");
  figures.excluded_pixels = one.count<std::int64_t>("excluded_pixels");
  figures.message = one.string("message");
  return figures;
}

/// Collects runs, one after the other.
class Joiner {
 public:
  void add(const RunFolder& run) {
    const std::string file = (run.folder / "results.json").string();
    const json text = parse_file(file);
    const Member root(file, "the file", text);
    const std::size_t column = column_of(root, run);
    joined_.drivers[column].seconds += root.number("seconds").value_or(0);
    joined_.drivers[column].folders.push_back(run.folder);
    const std::string suite = root.string("suite");
    if (std::find(suites_.begin(), suites_.end(), suite) == suites_.end()) {
      suites_.push_back(suite);
    }
    const json& cases = root.array("cases");
    for (std::size_t i = 0; i < cases.size(); ++i) {
      add_case(file, "cases[" + std::to_string(i) + "]", cases[i], suite, column);
    }
  }

  JoinedRuns finish() {
    for (CaseRow& row : joined_.cases) {
      row.cells.resize(joined_.drivers.size());
    }
    // A suite that one driver ran before another, or with cases of its own, still stands together.
    std::stable_sort(joined_.cases.begin(), joined_.cases.end(),
                     [this](const CaseRow& a, const CaseRow& b) { return place_of(a.suite) < place_of(b.suite); });
    return std::move(joined_);
  }

 private:
  std::size_t column_of(const Member& root, const RunFolder& run) {
    DriverColumn read = read_column(root, run);
    std::vector<DriverColumn>& drivers = joined_.drivers;
    const auto known = std::find_if(drivers.begin(), drivers.end(), [&run](const DriverColumn& one) { return one.name == run.driver; });
    if (known == drivers.end()) {
      drivers.push_back(std::move(read));
      return drivers.size() - 1;
    }
    if (!same_context(*known, read)) {
      root.fail("was drawn by '" + scene::legible(read.renderer) + "', other runs of '" + run.driver + "' by '" +
                scene::legible(known->renderer) + "'");
    }
    return static_cast<std::size_t>(known - drivers.begin());
  }

  void add_case(const std::string& file, const std::string& element, const json& value, const std::string& suite, std::size_t column) {
    const std::string name = Member(file, element, value).string("name");
    const Member one(file, element + " '" + scene::legible(name) + "'", value);
    const auto [place, fresh] = rows_.try_emplace({suite, name}, joined_.cases.size());
    if (fresh) {
      joined_.cases.push_back({suite, name, {}});
    }
    std::vector<std::optional<CaseFigures>>& cells = joined_.cases[place->second].cells;
    cells.resize(std::max(cells.size(), column + 1));
    if (cells[column]) {
      one.fail("is given twice");
    }
    cells[column] = read_figures(one);
  }

  std::ptrdiff_t place_of(const std::string& suite) const { return std::find(suites_.begin(), suites_.end(), suite) - suites_.begin(); }

  JoinedRuns joined_;
  std::vector<std::string> suites_;
  std::map<std::pair<std::string, std::string>, std::size_t> rows_;
};

template <class Value>
json value_or_null(const std::optional<Value>& value) {
  return value ? json(*value) : json(nullptr);
}

json totals_json(const ColumnTotals& totals) {
  json summary = json::object();
  for (const auto& [status, count] : totals.counts) {
    summary[to_string(status)] = count;
  }
  summary["missing"] = totals.missing;
  return {{"summary", summary},
          {"bound_ratio", {{"median", totals.median_bound_ratio}, {"p99", totals.p99_bound_ratio}, {"worst", totals.worst_bound_ratio}}},
          {"excluded_share", totals.excluded_share}};
}

json driver_json(const DriverColumn& driver, const ColumnTotals& totals) {
  json made = totals_json(totals);
  made["name"] = driver.name;
  made["renderer"] = text_or_null(driver.renderer);
  made["version"] = text_or_null(driver.version);
  made["subpixel_bits"] = value_or_null(driver.subpixel_bits);
  made["mediump_bits"] = value_or_null(driver.mediump_bits);
  made["seconds"] = driver.seconds;
  for (const std::filesystem::path& folder : driver.folders) {
    made["folders"].push_back(folder.string());
  }
  return made;
}

json cell_json(const std::optional<CaseFigures>& cell) {
  if (!cell) {
    return nullptr;
  }
  return {{"status", to_string(cell->status)},
          {"bound_ratio", value_or_null(cell->bound_ratio)},
          {"p99_rel", value_or_null(cell->p99_rel)},
          {"median_bound", value_or_null(cell->median_bound)},
          {"compared_pixels", value_or_null(cell->compared_pixels)},
          {"excluded_pixels", value_or_null(cell->excluded_pixels)},
          {"message", cell->message}};
}

}  // namespace

ColumnTotals JoinedRuns::totals(std::size_t driver) const {
  ColumnTotals totals;
  for (const Status status : statuses) {
    totals.counts[status] = 0;
  }
  std::vector<double> ratios;
  std::int64_t excluded = 0;
  std::int64_t covered = 0;
  for (const CaseRow& row : cases) {
    const std::optional<CaseFigures>& cell = row.cells.at(driver);
    if (!cell) {
      ++totals.missing;
      continue;
    }
    ++totals.counts[cell->status];
    if (cell->bound_ratio) {
      ratios.push_back(*cell->bound_ratio);
    }
    excluded += cell->excluded_pixels.value_or(0);
    covered += cell->excluded_pixels.value_or(0) + cell->compared_pixels.value_or(0);
  }
  totals.median_bound_ratio = nearest_rank(ratios, 0.5);
  totals.p99_bound_ratio = nearest_rank(ratios, 0.99);
  totals.worst_bound_ratio = nearest_rank(ratios, 1);
  totals.excluded_share = covered > 0 ? static_cast<double>(excluded) / static_cast<double>(covered) : 0;
  return totals;
}

bool JoinedRuns::ok() const {
  return std::all_of(cases.begin(), cases.end(), [](const CaseRow& row) {
    return std::all_of(row.cells.begin(), row.cells.end(), [](const std::optional<CaseFigures>& cell) {
      return cell && (cell->status == Status::Pass || cell->status == Status::Approximation || cell->status == Status::Unsupported);
    });
  });
}

JoinedRuns join_runs(const std::vector<RunFolder>& runs) {
  Joiner joiner;
  for (const RunFolder& run : runs) {
    joiner.add(run);
  }
  return joiner.finish();
}

std::string joined_json(const JoinedRuns& joined) {
  json drivers = json::array();
  for (std::size_t i = 0; i < joined.drivers.size(); ++i) {
    drivers.push_back(driver_json(joined.drivers[i], joined.totals(i)));
  }
  json cases = json::array();
  for (const CaseRow& row : joined.cases) {
    json cells = json::object();
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      cells[joined.drivers[i].name] = cell_json(row.cells[i]);
    }
    cases.push_back({{"suite", row.suite}, {"name", row.name}, {"drivers", cells}});
  }
  return json_text(json{{"drivers", drivers}, {"cases", cases}}, 1) + "\n";
}

std::optional<double> excluded_share(const CaseFigures& figures) {
  const std::int64_t covered = figures.compared_pixels.value_or(0) + figures.excluded_pixels.value_or(0);
  if (covered == 0) {
    return std::nullopt;
  }
  return static_cast<double>(figures.excluded_pixels.value_or(0)) / static_cast<double>(covered);
}

}  // namespace sheen::conformance
