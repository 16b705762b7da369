#include "scene/gltf_uri.h"

#include <algorithm>
#include <cctype>
#include <vector>

namespace sheen::scene {
namespace {

// RFC 3986, section 3.1: scheme = ALPHA *( ALPHA / DIGIT / "+" / "-" / "." ) ":".
std::string_view scheme_of(std::string_view uri) {
  if (uri.empty() || std::isalpha(static_cast<unsigned char>(uri[0])) == 0) {
    return {};
  }
  for (std::size_t i = 1; i < uri.size(); ++i) {
    const auto c = static_cast<unsigned char>(uri[i]);
    if (c == ':') {
      return uri.substr(0, i);
    }
    if (std::isalnum(c) == 0 && c != '+' && c != '-' && c != '.') {
      return {};
    }
  }
  return {};
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') {
    return c - '0';
  }
  if (c >= 'a' && c <= 'f') {
    return c - 'a' + 10;
  }
  if (c >= 'A' && c <= 'F') {
    return c - 'A' + 10;
  }
  return -1;
}

std::string quoted(std::string_view uri) {
  return std::string("'").append(uri).append("'");
}

// RFC 3986, section 2.1. A plus sign stands for itself.
std::string percent_decoded(const Element& element, std::string_view uri) {
  std::string result;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      result += uri[i];
      continue;
    }
    const int high = i + 2 < uri.size() ? hex_digit(uri[i + 1]) : -1;
    const int low = i + 2 < uri.size() ? hex_digit(uri[i + 2]) : -1;
    if (high < 0 || low < 0) {
      element.fail("uri", quoted(uri) + " has a percent sign without two hexadecimal digits");
    }
    result += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return result;
}

}  // namespace

bool is_data_uri(std::string_view uri) {
  const std::string_view scheme = scheme_of(uri);
  return scheme.size() == 4 &&
         std::equal(scheme.begin(), scheme.end(), "data", [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

std::string_view base64_payload(const Element& element, std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64")) {
    element.fail("uri", "is a data URI without ';base64,' (section 2.8)");
  }
  const std::string_view payload = uri.substr(comma + 1);
  const std::size_t end = std::min(payload.find('='), payload.size());
  const std::size_t padding = payload.size() - end;
  const auto in_alphabet = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '/'; };
  if (!std::all_of(payload.begin(), payload.begin() + static_cast<std::ptrdiff_t>(end), in_alphabet) || padding > 2 || end % 4 == 1 ||
      payload.find_first_not_of('=', end) != std::string_view::npos) {
    element.fail("uri", "holds a data URI that is not base64 (RFC 4648)");
  }
  return payload;
}

std::size_t base64_size(std::string_view payload) {
  return std::min(payload.find('='), payload.size()) * 3 / 4;
}

std::filesystem::path path_of_uri(const Element& element, std::string_view uri) {
  if (!scheme_of(uri).empty()) {
    element.fail("uri", quoted(uri) + " has a scheme: only data URIs and paths inside the asset's folder are read (section 2.8)");
  }
  const std::string decoded = percent_decoded(element, uri);
  if (decoded.empty()) {
    element.fail("uri", "is empty");
  }
  const std::string leaves = quoted(uri) + " leaves the asset's folder (section 2.8)";
  if (decoded.front() == '/' || decoded.find('\\') != std::string::npos || decoded.find('\0') != std::string::npos) {
    element.fail("uri", leaves);
  }
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= decoded.size();) {
    const std::size_t end = std::min(decoded.find('/', begin), decoded.size());
    const std::string part = decoded.substr(begin, end - begin);
    begin = end + 1;
    if (part.empty() || part == ".") {
      continue;
    }
    if (part != "..") {
      parts.push_back(part);
    } else if (parts.empty()) {
      element.fail("uri", leaves);
    } else {
      parts.pop_back();
    }
  }
  std::filesystem::path result;
  for (const std::string& part : parts) {
    result /= part;
  }
  if (result.empty()) {
    element.fail("uri", quoted(uri) + " names no file");
  }
  return result;
}

}  // namespace sheen::scene
