#include "conformance/html.h"

#include <array>
#include <cstdio>

#include "conformance/report.h"

namespace sheen::conformance {

std::string html_number(double value, int digits) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*g", digits, value);
  return text.data();
}

std::string html_row(const std::vector<std::string>& cells, const std::string& tag) {
  std::string html = "<tr>";
  for (const std::string& cell : cells) {
    html.append("<").append(tag).append(">").append(cell).append("</").append(tag).append(">");
  }
  return html + "</tr>";
}

std::string html_filters(std::size_t total, const std::vector<std::pair<std::string, std::size_t>>& counts) {
  std::string html = "<nav><button data-status=all>all " + std::to_string(total) + "</button>";
  for (const auto& [word, count] : counts) {
    if (count > 0) {
      html += "<button data-status=" + word + " style=\"color:var(--" + word + ")\">" + word + " " + std::to_string(count) + "</button>";
    }
  }
  return html + "<input type=search placeholder=\"words in the case's name\" aria-label=\"words in the case's name\"></nav>";
}

std::string html_page(const std::string& title, const std::string& more_style, const std::string& header, const std::string& main) {
  return "<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8><meta name=viewport content=\"width=device-width\"><title>" +
         escape_html(title) + "</title><style>" + report_style + more_style + "</style></head><body>\n<header>" + header +
         "</header>\n<main>\n" + main + "</main><script>" + report_script + "</script></body></html>\n";
}

}  // namespace sheen::conformance
