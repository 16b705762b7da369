#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace sheen::conformance {

/// A number as a page shows it, with that many significant digits.
std::string html_number(double value, int digits = 3);

/// A row of a table; the cells are HTML already. @param tag  "td" or "th"
std::string html_row(const std::vector<std::string>& cells, const std::string& tag = "td");

/// Buttons and a search box that choose among the elements with `data-name` by the words in their `data-status`.
/// @param counts  each word, and how many elements have it; a word that none has gets no button
std::string html_filters(std::size_t total, const std::vector<std::pair<std::string, std::size_t>>& counts);

/// A whole page without references to others. @param title  text; more_style  CSS after the reports' own; header, main  HTML
std::string html_page(const std::string& title, const std::string& more_style, const std::string& header, const std::string& main);

}  // namespace sheen::conformance
