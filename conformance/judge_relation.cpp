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
                 CaseResult& result, std::vector<image::Image>& pictures, std::vector<PreparedCase>& prepared) {
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
    if (drawing.prepared) {
      prepared.push_back(std::move(*drawing.prepared));
    }
    result.scenes.back().png = keep_candidate(images, relation.scenes[i].name, drawing.answer.image, pictures.back());
  }
  return true;
}

void judge_pictures(const Relation& relation, const std::vector<image::Image>& pictures, const Hello& hello, CaseResult& result) {
  RelationRules rules;
  rules.srgb8 = hello.encoding == Encoding::Srgb8;
  rules.tone_mapped = hello.maps_tones();
  rules.ours = hello.is_ours();
  rules.subpixel_bits = hello.subpixel_bits;
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

bool shows_nothing(const image::Image& picture) {
  for (const char* name : {"R", "G", "B", "A"}) {
    const int c = picture.channel(name);
    for (int y = 0; y < picture.height && c >= 0; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        if (picture.at(x, y, c) != 0) {
          return false;
        }
      }
    }
  }
  return true;
}

/// Of the scenes the one that is off most decides. One that shows nothing, as it must, says nothing.
void judge_by_goldens(const Relation& relation, const std::vector<image::Image>& pictures, const std::vector<PreparedCase>& prepared,
                      const Hello& hello, CaseResult& result) {
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const image::Image& golden = prepared[i].reference.image;
    if (shows_nothing(golden) && shows_nothing(pictures[i])) {
      continue;
    }
    VerdictRules rules = rules_of(relation.scenes[i], prepared[i], hello);
    rules.most_excluded = most_left_out;
    const Verdict verdict = judge(pictures[i], golden, rules);
    const bool passes = verdict.status == Status::Pass;
    if (!result.verdict || (result.status == Status::Pass && (!passes || verdict.bound_ratio > result.verdict->bound_ratio))) {
      result.verdict = verdict;
      result.status = verdict.status;
      result.message = verdict.message.empty() ? "" : "'" + relation.labels[i] + "': " + verdict.message;
      result.pictures.difference = image::encode_png(paint_ratios(ratio_map(pictures[i], golden, rules), golden.width, golden.height));
    }
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
    std::vector<image::Image> pictures;
    std::vector<PreparedCase> prepared;
    if (!draw_scenes(relation, draw, images, result, pictures, prepared)) {
      return result;
    }
    if (prepared.size() < pictures.size()) {
      judge_pictures(relation, pictures, hello, result);
      return result;
    }
    judge_by_goldens(relation, pictures, prepared, hello, result);
    if (relation.exact && first.precision != golden::Precision::Mediump && result.status == Status::Pass) {
      CaseResult to_the_bit = result;
      judge_pictures(relation, pictures, hello, to_the_bit);
      result = to_the_bit.status == Status::Pass ? result : to_the_bit;
    }
  } catch (const std::exception& error) {
    result.status = Status::Invalid;
    result.message = error.what();
  }
  return result;
}

}  // namespace sheen::conformance
