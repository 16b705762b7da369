#include "conformance/joined_report.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "conformance/html.h"
#include "conformance/report.h"

namespace sheen::conformance {
namespace {

constexpr const char* missing_word = "missing";

constexpr const char* joined_style = R"css(
:root { --missing: #8a8f98; }
header, main { max-width: 1500px; }
header { padding-bottom: 0; }
main { padding-top: 0; }
table.drivers { margin: 14px 0; }
table.drivers td { max-width: 320px; overflow-wrap: anywhere; vertical-align: top; padding-right: 24px; }
table.cases { width: 100%; font-size: 13px; background: var(--paper); }
table.drivers th, table.drivers td, table.cases th, table.cases td { text-align: left; }
table.cases th, table.cases td { padding: 4px 12px; vertical-align: top; }
table.cases td:first-child { font-family: ui-monospace, "DejaVu Sans Mono", monospace; overflow-wrap: anywhere; }
tr[hidden] { display: none; }
.suite { color: var(--soft); }
.small { display: block; white-space: nowrap; color: var(--soft); font-size: 11px; }
table.cases .message { font: 12px/1.4 system-ui, "DejaVu Sans", sans-serif; max-width: 90ch; }
)css";

/// The worst statuses first, then what a cell without one says.
std::vector<std::string> words() {
  std::vector<std::string> all;
  for (const Status status : statuses) {
    all.push_back(to_string(status));
  }
  all.emplace_back(missing_word);
  return all;
}

std::string word_of(const std::optional<CaseFigures>& cell) {
  return cell ? to_string(cell->status) : missing_word;
}

std::string small(const std::string& text) {
  return "<span class=small>" + text + "</span>";
}

std::string share(double of_one) {
  return html_number(100 * of_one) + " %";
}

std::string cell_html(const std::optional<CaseFigures>& cell) {
  const std::string word = word_of(cell);
  std::string html = "<span class=badge style=\"--status:var(--" + word + ")\">" + word + "</span>";
  if (!cell) {
    return html;
  }
  if (cell->bound_ratio) {
    html += "<b>" + html_number(*cell->bound_ratio) + "</b>";
  }
  std::string figures = cell->p99_rel ? "p99 " + html_number(*cell->p99_rel) : "";
  if (const std::optional<double> excluded = excluded_share(*cell)) {
    figures += (figures.empty() ? "excluded " : ", excluded ") + share(*excluded);
  }
  html += figures.empty() ? "" : small(figures);
  // A law between pictures and a case that was refused have no bound.
  return html + (cell->median_bound.value_or(0) > 0 ? small("median bound " + html_number(*cell->median_bound)) : "");
}

/// What the drivers that did not pass a case say of it.
std::string messages(const JoinedRuns& joined, const CaseRow& row) {
  std::string html;
  for (std::size_t i = 0; i < row.cells.size(); ++i) {
    if (row.cells[i] && row.cells[i]->status != Status::Pass && !row.cells[i]->message.empty()) {
      html += "<div class=message>" + escape_html(joined.drivers[i].name + ": " + row.cells[i]->message) + "</div>";
    }
  }
  return html;
}

std::string case_row(const JoinedRuns& joined, const CaseRow& row) {
  std::string statuses_here;
  for (const std::string& word : words()) {
    if (std::any_of(row.cells.begin(), row.cells.end(), [&word](const auto& cell) { return word_of(cell) == word; })) {
      statuses_here += (statuses_here.empty() ? "" : " ") + word;
    }
  }
  const std::string name = escape_html(row.name);
  std::string html = "<tr data-name=\"" + escape_html(row.suite) + "." + name + "\" data-status=\"" + statuses_here +
                     "\"><td><span class=suite>" + escape_html(row.suite) + ".</span>" + name + messages(joined, row) + "</td>";
  for (const std::optional<CaseFigures>& cell : row.cells) {
    html += "<td>" + cell_html(cell) + "</td>";
  }
  return html + "</tr>\n";
}

std::string counts_text(const ColumnTotals& totals) {
  std::string text;
  const auto add = [&text](const std::string& word, int count) {
    if (count > 0) {
      text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + word;
    }
  };
  for (const Status status : statuses) {
    add(to_string(status), totals.counts.at(status));
  }
  add(missing_word, totals.missing);
  return text.empty() ? "none" : text;
}

/// What a driver says of itself, and what its column comes to.
std::string driver_table(const JoinedRuns& joined) {
  std::vector<ColumnTotals> totals;
  std::vector<std::string> names = {""};
  for (std::size_t i = 0; i < joined.drivers.size(); ++i) {
    totals.push_back(joined.totals(i));
    names.push_back(escape_html(joined.drivers[i].name));
  }
  std::string html = "<table class=drivers>" + html_row(names, "th");
  const auto add = [&](const std::string& what, const std::function<std::string(const DriverColumn&, const ColumnTotals&)>& text) {
    std::vector<std::string> cells = {what};
    for (std::size_t i = 0; i < joined.drivers.size(); ++i) {
      cells.push_back(escape_html(text(joined.drivers[i], totals[i])));
    }
    html += html_row(cells);
  };
  const auto bits = [](const std::optional<int>& count) { return count ? std::to_string(*count) : std::string("not said"); };
  add("driver", [](const auto& driver, const auto&) { return driver.renderer; });
  add("context", [](const auto& driver, const auto&) { return driver.version; });
  add("sub-pixel bits", [&](const auto& driver, const auto&) { return bits(driver.subpixel_bits); });
  add("fraction bits of mediump", [&](const auto& driver, const auto&) { return bits(driver.mediump_bits); });
  add("cases", [](const auto&, const auto& total) { return counts_text(total); });
  add("error / bound: median, p99, worst", [](const auto&, const auto& total) {
    return html_number(total.median_bound_ratio) + ", " + html_number(total.p99_bound_ratio) + ", " + html_number(total.worst_bound_ratio);
  });
  add("excluded", [](const auto&, const auto& total) { return share(total.excluded_share); });
  add("seconds", [](const auto& driver, const auto&) { return html_number(driver.seconds, 4); });
  add("reports", [](const auto& driver, const auto&) {
    std::string text;
    for (const std::filesystem::path& folder : driver.folders) {
      text += (text.empty() ? "" : ", ") + folder.string();
    }
    return text;
  });
  return html + "</table>";
}

std::vector<std::pair<std::string, std::size_t>> rows_by_word(const JoinedRuns& joined) {
  std::vector<std::pair<std::string, std::size_t>> counts;
  for (const std::string& word : words()) {
    const auto has = [&word](const CaseRow& row) {
      return std::any_of(row.cells.begin(), row.cells.end(), [&word](const auto& cell) { return word_of(cell) == word; });
    };
    counts.emplace_back(word, static_cast<std::size_t>(std::count_if(joined.cases.begin(), joined.cases.end(), has)));
  }
  return counts;
}

}  // namespace

std::string joined_html(const JoinedRuns& joined) {
  const std::string title = "sheen-cts: " + std::to_string(joined.drivers.size()) + " drivers side by side";
  std::vector<std::string> names = {"case"};
  for (const DriverColumn& driver : joined.drivers) {
    names.push_back(escape_html(driver.name) + small("status, error / bound"));
  }
  std::string rows = "<table class=cases>" + html_row(names, "th") + "\n";
  for (const CaseRow& row : joined.cases) {
    rows += case_row(joined, row);
  }
  return html_page(title, joined_style,
                   "<h1>" + title + "</h1><p>Every case on every driver.</p>" + driver_table(joined) +
                       html_filters(joined.cases.size(), rows_by_word(joined)),
                   rows + "</table>");
}

}  // namespace sheen::conformance
