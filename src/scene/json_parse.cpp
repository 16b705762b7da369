#include "scene/json_parse.h"

#include <cstddef>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "scene/scene.h"

namespace sheen::scene {
namespace {

using nlohmann::json;

// Deeper than any glTF document needs (extensions and extras included), and shallow enough for readers that recurse.
constexpr std::size_t deepest_nesting = 128;

// nlohmann's number overflow, thrown as out_of_range (its documentation, "Exceptions", 406).
constexpr int number_overflow = 406;

// Builds the document and keeps the path of the value being read, which nlohmann's own builder does not tell in its errors.
class Builder : public json::json_sax_t {
 public:
  explicit Builder(const std::string& file) : file_(file) {}

  json take() { return std::move(root_); }

  bool null() override { return add(json()); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(json::number_integer_t value) override { return add(value); }
  bool number_unsigned(json::number_unsigned_t value) override { return add(value); }
  bool number_float(json::number_float_t value, const json::string_t&) override { return add(value); }
  bool string(json::string_t& value) override { return add(std::move(value)); }
  bool binary(json::binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(json::object()); }
  bool start_array(std::size_t) override { return open(json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(json::string_t& value) override {
    open_.back().key = value;
    if (open_.back().container->contains(value)) {
      fail("is given twice (glTF 2.0, section 2.7: names must be unique)");
    }
    return true;
  }

  bool parse_error(std::size_t position, const std::string& token, const nlohmann::detail::exception& error) override {
    if (error.id == number_overflow) {
      fail("is " + token + ", which is not finite (glTF 2.0)");
    }
    fail("is not JSON: unexpected '" + token + "' at byte " + std::to_string(position) + " (RFC 8259)");
  }

 private:
  struct Open {
    json* container;
    std::string key;
  };

  [[noreturn]] void fail(const std::string& rule) const {
    std::string path;
    for (const Open& level : open_) {
      if (level.container->is_array()) {
        // An open element is in its array already; a plain value at fault is not.
        const std::size_t index = level.container->size() - (&level == &open_.back() ? 0 : 1);
        path.append("[").append(std::to_string(index)).append("]");
      } else if (!level.key.empty()) {
        path.append(path.empty() ? "" : ".").append(level.key);
      }
    }
    throw Error(file_, path.empty() ? "document" : path, rule);
  }

  json* insert(json&& value) {
    if (open_.empty()) {
      root_ = std::move(value);
      return &root_;
    }
    json& container = *open_.back().container;
    if (container.is_array()) {
      container.push_back(std::move(value));
      return &container.back();
    }
    return &(container[open_.back().key] = std::move(value));
  }

  bool add(json&& value) {
    insert(std::move(value));
    return true;
  }

  bool open(json&& value) {
    if (open_.size() >= deepest_nesting) {
      fail("is nested deeper than " + std::to_string(deepest_nesting) + " levels");
    }
    json* container = insert(std::move(value));
    open_.push_back({container, {}});
    return true;
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  const std::string& file_;
  json root_;
  std::vector<Open> open_;
};

}  // namespace

json parse_json(std::string_view text, const std::string& file) {
  Builder builder(file);
  if (!json::sax_parse(text.begin(), text.end(), &builder)) {
    throw Error(file, "document", "is not JSON (RFC 8259)");
  }
  return builder.take();
}

}  // namespace sheen::scene
