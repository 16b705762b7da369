#include "conformance/relation.h"

#include <algorithm>
#include <set>
#include <utility>

#include "conformance/suite.h"

namespace sheen::conformance {
namespace {

using nlohmann::json;

constexpr std::array<std::pair<RelationKind, const char*>, 4> kinds = {{{RelationKind::Equal, "equal"},
                                                                        {RelationKind::Differs, "differs"},
                                                                        {RelationKind::Brighter, "brighter"},
                                                                        {RelationKind::Linear, "linear"}}};

/// Reads the members of a `relation`, naming file and element in what it throws.
class RelationReader {
 public:
  RelationReader(const json& declared, std::string file, std::string element)
      : declared_(declared), file_(std::move(file)), element_(std::move(element)) {
    check_keys(declared_,
               {"kind", "law", "source", "scenes", "weights", "tolerance", "share", "region", "mirrored", "moved", "exact", "excuse"},
               file_, element_);
  }

  [[noreturn]] void fail(const std::string& rule) const { throw SuiteError(file_, element_, rule); }

  std::string text(const char* key) const {
    if (!declared_.contains(key) || !declared_[key].is_string() || declared_[key].get<std::string>().empty()) {
      fail(std::string("needs '") + key + "' (a text)");
    }
    return declared_[key].get<std::string>();
  }
  bool flag(const char* key) const {
    if (!declared_.contains(key)) {
      return false;
    }
    if (!declared_[key].is_boolean()) {
      fail(std::string(key) + " must be true or false");
    }
    return declared_[key].get<bool>();
  }
  bool has(const char* key) const { return declared_.contains(key); }
  /// As many finite numbers as asked for.
  std::vector<double> numbers(const char* key, std::size_t count) const {
    const json& list = declared_[key];
    if (!list.is_array() || list.size() != count || !std::all_of(list.begin(), list.end(), [](const json& v) { return v.is_number(); })) {
      fail(std::string(key) + " must be " + std::to_string(count) + " numbers");
    }
    return list.get<std::vector<double>>();
  }
  RelationKind kind() const {
    const std::string word = text("kind");
    std::string known;
    for (const auto& [kind, name] : kinds) {
      if (word == name) {
        return kind;
      }
      known += (known.empty() ? "" : ", ") + std::string(name);
    }
    fail("unknown kind '" + word + "'; known: " + known);
  }
  const json& scenes() const {
    if (!declared_.contains("scenes") || !declared_["scenes"].is_array() || declared_["scenes"].size() < 2) {
      fail("needs 'scenes' (at least two)");
    }
    return declared_["scenes"];
  }
  void tolerance(Relation& relation) const {
    if (!has("tolerance")) {
      return;
    }
    const json& stated = declared_["tolerance"];
    check_keys(stated, {"relative", "absolute", "because"}, file_, element_ + ".tolerance");
    const bool good = stated.value("relative", json(0.0)).is_number() && stated.value("absolute", json(0.0)).is_number() &&
                      stated.contains("because") && stated["because"].is_string();
    if (!good) {
      fail("tolerance holds 'relative' and 'absolute' (numbers) and 'because' (a text)");
    }
    relation.relative = stated.value("relative", relation.relative);
    relation.absolute = stated.value("absolute", relation.absolute);
  }

 private:
  const json& declared_;
  std::string file_;
  std::string element_;
};

void add_scenes(const json& scenes, const SweepPoint& point, const std::string& file, const std::string& element,
                const RelationReader& reader, Relation& relation) {
  std::set<std::string> seen;
  for (const json& scene : scenes) {
    check_keys(scene, {"label", "patch"}, file, element + ".scenes");
    const bool good = scene.contains("label") && scene["label"].is_string() && scene.contains("patch") && scene["patch"].is_object();
    if (!good) {
      reader.fail("each scene needs a label (string) and a patch (object)");
    }
    const std::string label = scene["label"].get<std::string>();
    if (label.find('.') != std::string::npos || !seen.insert(label).second) {
      reader.fail("a scene's label is its own and holds no dot: '" + label + "'");
    }
    SweepPoint drawn{point.name + "." + label, point.description};
    drawn.description.merge_patch(scene["patch"]);
    relation.labels.push_back(label);
    relation.scenes.push_back(make_case(std::move(drawn), file, element));
    const Case& first = relation.scenes.front();
    if (relation.scenes.back().width != first.width || relation.scenes.back().height != first.height) {
      reader.fail("its scenes must be of one size");
    }
  }
}

void check_limits(const Relation& relation, const RelationReader& reader) {
  const auto& [left, top, right, bottom] = relation.region;
  if (!(left >= 0 && top >= 0 && right <= 1 && bottom <= 1 && left < right && top < bottom)) {
    reader.fail("region must be left, top, right, bottom within 0 and 1");
  }
  if (!(relation.share > 0 && relation.share <= 1)) {
    reader.fail("share must be above 0 and at most 1");
  }
  if (!(relation.relative >= 0 && relation.relative < 1 && relation.absolute > 0 && relation.absolute < 1)) {
    reader.fail("tolerance must be below 1, the absolute one above 0");
  }
  if (relation.exact && relation.kind != RelationKind::Equal) {
    reader.fail("only what is equal can be exact");
  }
}

}  // namespace

std::string to_string(RelationKind kind) {
  for (const auto& [candidate, word] : kinds) {
    if (candidate == kind) {
      return word;
    }
  }
  throw std::logic_error("a kind without a word");
}

Relation make_relation(SweepPoint point, const std::string& file, const std::string& element) {
  const std::string where = element + " relation '" + point.name + "'";
  const json declared = point.description.at("relation");
  point.description.erase("relation");
  const RelationReader reader(declared, file, where);
  Relation relation;
  relation.name = point.name;
  relation.kind = reader.kind();
  relation.law = reader.text("law");
  relation.source = reader.text("source");
  relation.mirrored = reader.flag("mirrored");
  relation.moved = reader.flag("moved");
  relation.exact = reader.flag("exact");
  relation.excuse = reader.has("excuse") ? reader.text("excuse") : "";
  reader.tolerance(relation);
  if (reader.has("share")) {
    if (!declared["share"].is_number()) {
      reader.fail("share must be a number");
    }
    relation.share = declared["share"].get<double>();
  }
  if (reader.has("region")) {
    const std::vector<double> region = reader.numbers("region", 4);
    std::copy(region.begin(), region.end(), relation.region.begin());
  }
  add_scenes(reader.scenes(), point, file, where, reader, relation);
  if (reader.has("weights") != (relation.kind == RelationKind::Linear)) {
    reader.fail("'weights' and the kind \"linear\" go together");
  }
  if (relation.kind == RelationKind::Linear) {
    relation.weights = reader.numbers("weights", relation.scenes.size());
  }
  check_limits(relation, reader);
  return relation;
}

}  // namespace sheen::conformance
