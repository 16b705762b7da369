#include "conformance/judge_relation.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "conformance/relate.h"
#include "image/io.h"

namespace sheen::conformance {
namespace {

/// Draws the scenes and reads the pictures. False, with status and message set, when one is missing.
bool draw_scenes(const Relation& relation, const std::function<Drawing(const Case&)>& draw, const std::filesystem::path& images,
                 CaseResult& result, std::vector<image::Image>& pictures, RelationRules& rules) {
  for (std::size_t i = 0; i < relation.scenes.size(); ++i) {
    Drawing drawing = draw(relation.scenes[i]);
    result.seconds += drawing.answer.seconds;
    result.scenes.push_back({relation.labels[i], drawing.scene_file, {}});
    if (drawing.answer.status != AnswerStatus::Rendered) {
      result.status = status_of(drawing.answer.status);
      result.message = "'" + relation.labels[i] + "': " + (drawing.answer.message.empty() ? "the viewer says so" : drawing.answer.message);
      return false;
    }
    pictures.push_back(image::read(drawing.answer.image));
    if (rules.ours) {
      rules.goldens.push_back(std::move(drawing.golden));
    }
    result.scenes.back().png = keep_candidate(images, relation.scenes[i].name, drawing.answer.image, pictures.back());
  }
  return true;
}

RelationRules rules_for(const Relation& relation, const Hello& hello) {
  RelationRules rules;
  rules.srgb8 = hello.encoding == Encoding::Srgb8;
  rules.tone_mapped = hello.maps_tones();
  rules.ours = hello.is_ours();
  rules.subpixel_bits = hello.subpixel_bits;
  rules.mediump = relation.scenes.front().precision == golden::Precision::Mediump;
  return rules;
}

void judge_pictures(const Relation& relation, const std::vector<image::Image>& pictures, const Hello& hello, const RelationRules& rules,
                    CaseResult& result) {
  result.verdict = relate(relation, pictures, rules);
  result.status = result.verdict->status;
  result.message = result.verdict->message;
  result.pictures.difference = image::encode_png(
      paint_ratios(relation_map(relation, pictures, rules), relation.scenes.front().width, relation.scenes.front().height));
  if (result.status != Status::Fail) {
    return;
  }
  result.message += "; broken: " + result.law;
  if (!relation.excuse.empty() && !hello.takes_settings() && result.verdict->nonfinite_pixels == 0) {
    result.status = Status::Approximation;
    result.message += "; allowed, for " + relation.excuse;
  }
}

}  // namespace

CaseResult judge_relation(const Relation& relation, const std::function<Drawing(const Case&)>& draw, const Hello& hello,
                          const std::filesystem::path& images) {
  const Case& first = relation.scenes.front();
  CaseResult result;
  result.name = relation.name;
  result.law = relation.law + " (" + relation.source + ")";
  result.model = to_string(first.model.visibility) + " " + to_string(first.model.scaling);
  result.width = first.width;
  result.height = first.height;
  try {
    RelationRules rules = rules_for(relation, hello);
    std::vector<image::Image> pictures;
    if (draw_scenes(relation, draw, images, result, pictures, rules)) {
      judge_pictures(relation, pictures, hello, rules, result);
    }
  } catch (const std::exception& error) {
    result.status = Status::Invalid;
    result.message = error.what();
  }
  return result;
}

}  // namespace sheen::conformance
