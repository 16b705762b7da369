#include "scene/json_element.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "scene/scene.h"

namespace sheen::scene {
namespace {

using nlohmann::json;

std::string number_text(double x) {
  return json(x).dump();
}

}  // namespace

std::string Range::text() const {
  const auto bound = [](double x) { return std::isinf(x) ? std::string(x < 0 ? "-inf" : "inf") : number_text(x); };
  const char* open = low_excluded || std::isinf(low) ? "(" : "[";
  const char* close = high_excluded || std::isinf(high) ? ")" : "]";
  return std::string(open).append(bound(low)).append(", ").append(bound(high)).append(close);
}

Element::Element(const std::string& file, const json& root) : file_(&file), value_(&root), owner_("document"), root_(true) {
  if (!root.is_object()) {
    fail(nullptr, "must be a JSON object");
  }
}

void Element::fail(const char* key, const std::string& rule) const {
  std::string member = path_;
  if (key != nullptr) {
    member += key;
  } else if (!member.empty()) {
    member.pop_back();
  }
  throw Error(*file_, owner_, (member.empty() ? "" : member + " ") + rule + " (" + specification_ + ")");
}

const json* Element::find(const char* key) const {
  const auto it = value_->find(key);
  return it == value_->end() ? nullptr : &*it;
}

const json& Element::require(const char* key) const {
  const json* value = find(key);
  if (value == nullptr) {
    fail(key, "is required");
  }
  return *value;
}

bool Element::has(const char* key) const {
  return find(key) != nullptr;
}

std::vector<std::string> Element::keys() const {
  std::vector<std::string> result;
  for (const auto& item : value_->items()) {
    result.push_back(item.key());
  }
  return result;
}

double Element::checked_number(const char* key, const json& value, const Range& range) const {
  if (!value.is_number()) {
    fail(key, std::string("must be a number, not ") + value.type_name());
  }
  const double x = value.get<double>();
  if (!std::isfinite(x)) {
    fail(key, "must be finite");
  }
  if (!range.contains(x)) {
    fail(key, "is " + number_text(x) + ", outside " + range.text());
  }
  return x;
}

double Element::number(const char* key, double fallback, const Range& range) const {
  const json* value = find(key);
  return value == nullptr ? fallback : checked_number(key, *value, range);
}

double Element::required_number(const char* key, const Range& range) const {
  return checked_number(key, require(key), range);
}

std::uint64_t Element::checked_count(const char* key, const json& value) const {
  // The largest integer that every JSON reader represents exactly (RFC 8259, section 6): anything beyond it is no size of a real file.
  constexpr double largest = 9007199254740992.0;
  if (!value.is_number()) {
    fail(key, std::string("must be a whole number, not ") + value.type_name());
  }
  const double x = value.get<double>();
  if (!(x >= 0.0 && x <= largest) || x != std::floor(x)) {
    fail(key, "is " + value.dump() + ", must be a whole number of at least 0");
  }
  return static_cast<std::uint64_t>(x);
}

std::uint64_t Element::count(const char* key, std::uint64_t fallback) const {
  const json* value = find(key);
  return value == nullptr ? fallback : checked_count(key, *value);
}

std::uint64_t Element::required_count(const char* key) const {
  return checked_count(key, require(key));
}

int Element::checked_index(const char* key, const json& value, std::size_t size, const char* target) const {
  const std::uint64_t index = checked_count(key, value);
  if (index >= size) {
    fail(key, "is " + std::to_string(index) + ", out of range: there are " + std::to_string(size) + " " + target);
  }
  return static_cast<int>(index);
}

int Element::index(const char* key, std::size_t size, const char* target) const {
  const json* value = find(key);
  return value == nullptr ? -1 : checked_index(key, *value, size, target);
}

int Element::required_index(const char* key, std::size_t size, const char* target) const {
  return checked_index(key, require(key), size, target);
}

std::vector<int> Element::indices(const char* key, std::size_t size, const char* target) const {
  std::vector<int> result;
  const json* value = find(key);
  if (value == nullptr) {
    return result;
  }
  if (!value->is_array()) {
    fail(key, std::string("must be an array of indices, not ") + value->type_name());
  }
  for (const json& item : *value) {
    result.push_back(checked_index(key, item, size, target));
  }
  return result;
}

bool Element::boolean(const char* key, bool fallback) const {
  const json* value = find(key);
  if (value == nullptr) {
    return fallback;
  }
  if (!value->is_boolean()) {
    fail(key, std::string("must be true or false, not ") + value->type_name());
  }
  return value->get<bool>();
}

std::string Element::string(const char* key, const std::string& fallback) const {
  const json* value = find(key);
  if (value == nullptr) {
    return fallback;
  }
  if (!value->is_string()) {
    fail(key, std::string("must be a string, not ") + value->type_name());
  }
  return value->get<std::string>();
}

std::string Element::required_string(const char* key) const {
  require(key);
  return string(key, "");
}

std::vector<std::string> Element::strings(const char* key) const {
  std::vector<std::string> result;
  const json* value = find(key);
  if (value == nullptr) {
    return result;
  }
  if (!value->is_array()) {
    fail(key, std::string("must be an array of strings, not ") + value->type_name());
  }
  for (const json& item : *value) {
    if (!item.is_string()) {
      fail(key, std::string("must hold strings, not ") + item.type_name());
    }
    result.push_back(item.get<std::string>());
  }
  return result;
}

std::vector<double> Element::numbers(const char* key, std::size_t size, const Range& range) const {
  std::vector<double> result;
  const json* value = find(key);
  if (value == nullptr) {
    return result;
  }
  if (!value->is_array() || value->size() != size) {
    fail(key, "must be an array of " + std::to_string(size) + " numbers");
  }
  result.reserve(size);
  for (const json& item : *value) {
    result.push_back(checked_number(key, item, range));
  }
  return result;
}

std::optional<Element> Element::child(const char* key) const {
  const json* value = find(key);
  if (value == nullptr) {
    return std::nullopt;
  }
  if (!value->is_object()) {
    fail(key, std::string("must be an object, not ") + value->type_name());
  }
  Element result = *this;
  result.value_ = value;
  result.path_ += std::string(key) + ".";
  result.root_ = false;
  return result;
}

Element Element::required_child(const char* key) const {
  require(key);
  return *child(key);
}

std::vector<Element> Element::children(const char* key) const {
  std::vector<Element> result;
  const json* value = find(key);
  if (value == nullptr) {
    return result;
  }
  if (!value->is_array()) {
    fail(key, std::string("must be an array, not ") + value->type_name());
  }
  result.reserve(value->size());
  for (std::size_t i = 0; i < value->size(); ++i) {
    const json& item = (*value)[i];
    std::string name = path_ + key + "[" + std::to_string(i) + "]";
    if (!item.is_object()) {
      fail(name.substr(path_.size()).c_str(), std::string("must be an object, not ") + item.type_name());
    }
    Element element = *this;
    element.value_ = &item;
    element.root_ = false;
    if (root_) {
      const auto given = item.find("name");
      if (given != item.end() && given->is_string()) {
        name += " '" + given->get<std::string>() + "'";
      }
      element.owner_ = name;
      element.path_.clear();
    } else {
      element.path_ = name + ".";
    }
    result.push_back(std::move(element));
  }
  return result;
}

std::optional<Element> Element::extension(const char* name) const {
  const std::optional<Element> extensions = child("extensions");
  if (!extensions) {
    return std::nullopt;
  }
  std::optional<Element> result = extensions->child(name);
  if (!result) {
    return std::nullopt;
  }
  result->specification_ = name;
  result->path_ = path_ + name + ".";
  result->root_ = root_;
  return result;
}

}  // namespace sheen::scene
