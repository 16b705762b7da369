#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "conformance/results.h"

namespace sheen::conformance {

/// index.html of a run: one file without references to others (styles, script and PNGs inside), so that it opens from disk and may be
/// mailed.
std::string report_html(const RunRecord& record);

/// RFC 4648 base64.
std::string base64(const std::vector<std::uint8_t>& bytes);
/// Text made safe for HTML content and attributes.
std::string escape_html(const std::string& text);

/// The page's styles and script (report_page.cpp).
extern const char* const report_style;
extern const char* const report_script;

}  // namespace sheen::conformance
