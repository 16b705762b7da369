#include "conformance/judge.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "conformance/case_scene.h"
#include "conformance/nearest_rank.h"
#include "conformance/replicas.h"
#include "image/io.h"
#include "scene/gltf.h"

namespace sheen::conformance {
namespace {

namespace fs = std::filesystem;
using albedo::SheenModel;

/// No text says how an environment is to be integrated. Further off than this is no approximation of it any more.
constexpr double most_approximated = 0.5;

/// Stops too bright from which a picture under punctual lights is shown darker too.
constexpr int hard_to_see = 4;

bool has_sheen(const scene::Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const scene::Material& material) { return material.sheen.enabled(); });
}

/// KHR_materials_sheen offers both in so many words: "one can use a simpler visibility term, like the one defined by Ashikhmin and Premoze"
/// and "you can use the VdotN term only"; and a viewer that knows nothing but the specification's own terms may be asked for another.
std::vector<SheenModel> allowed_forms(const SheenModel& asked) {
  std::vector<SheenModel> forms;
  for (const albedo::AlbedoScaling scaling : {albedo::AlbedoScaling::Full, albedo::AlbedoScaling::View}) {
    for (const albedo::Visibility visibility : {albedo::Visibility::Charlie, albedo::Visibility::Ashikhmin}) {
      if (visibility != asked.visibility || scaling != asked.scaling) {
        forms.push_back({visibility, scaling});
      }
    }
  }
  return forms;
}

std::string name_difference(const SheenModel& form, const SheenModel& asked) {
  std::string name;
  if (form.visibility != asked.visibility) {
    name = "visibility " + to_string(form.visibility);
  }
  if (form.scaling != asked.scaling) {
    name += (name.empty() ? "" : ", ") + ("albedo_scaling " + to_string(form.scaling));
  }
  return name;
}

std::string identify_form(const Case& one, const PreparedCase& prepared, const image::Image& candidate, VerdictRules rules,
                          const GoldenStore& store) {
  if (!has_sheen(prepared.scene)) {
    return "";
  }
  rules.golden_is_pxr24 = false;
  for (const SheenModel& form : allowed_forms(one.model)) {
    const golden::Settings settings = golden_settings(one, form, prepared.settings.subpixel_bits, prepared.settings.drawn_directions);
    const image::Image golden = store.computed(prepared.scene, prepared.scene_hash, settings);
    if (judge(candidate, golden, rules).status == Status::Pass) {
      return name_difference(form, one.model);
    }
  }
  return "";
}

/// Stops by which a picture is shown darker, so that all but 2 % of its values can be told apart: whole ones, 0 for most.
int stops_too_bright(const image::Image& picture) {
  std::vector<double> values;
  for (const char* name : {"R", "G", "B"}) {
    const int c = picture.channel(name);
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        if (picture.at(x, y, c) > 0) {
          values.push_back(picture.at(x, y, c));
        }
      }
    }
  }
  const double bright = nearest_rank(values, 0.98);
  return bright > 1 ? static_cast<int>(std::ceil(std::log2(bright))) : 0;
}

image::Image for_display(const image::Image& from, int darker) {
  const bool alpha = from.channel("A") >= 0;
  image::Image kept(from.width, from.height,
                    alpha ? std::vector<std::string>{"R", "G", "B", "A"} : std::vector<std::string>{"R", "G", "B"});
  for (std::size_t c = 0; c < kept.channels.size(); ++c) {
    const int source = from.channel(kept.channels[c]);
    if (source < 0) {
      continue;
    }
    for (int y = 0; y < from.height; ++y) {
      for (int x = 0; x < from.width; ++x) {
        kept.at(x, y, static_cast<int>(c)) = std::ldexp(from.at(x, y, source), c < 3 ? -darker : 0);
      }
    }
  }
  return kept;
}

std::vector<std::uint8_t> keep_bytes(const fs::path& file, const image::Image& picture, int darker) {
  const image::Image shown = for_display(picture, darker);
  image::write(file, shown);
  return image::encode_png(shown);
}

void keep_golden(const fs::path& images, const std::string& name, const image::Image& golden, int darker, CasePictures& pictures) {
  image::write(images / (name + ".golden.exr"), golden);
  pictures.golden = keep_bytes(images / (name + ".golden.png"), golden, darker);
}

void judge_picture(const Case& one, const PreparedCase& prepared, const image::Image& candidate, const Hello& hello,
                   const GoldenStore& store, CaseResult& result) {
  const VerdictRules rules = rules_of(one, prepared, hello);
  const image::Image& golden = prepared.reference.image;
  result.verdict = judge(candidate, golden, rules);
  result.status = result.verdict->status;
  result.message = result.verdict->message;
  result.pictures.difference = image::encode_png(paint_ratios(ratio_map(candidate, golden, rules), golden.width, golden.height));
  result.diagnosis = diagnose(prepared.scene, prepared.settings, candidate, golden, rules, *result.verdict);
  if (!result.diagnosis->sentence.empty()) {
    result.message += "; " + result.diagnosis->sentence;
  }
  if (result.verdict->mirrored_pixels > 0) {
    result.message += (result.message.empty() ? "" : "; ") + std::to_string(result.verdict->mirrored_pixels) +
                      " pixels whose normal faces away were left out";
  }
  if (result.status != Status::Fail || result.verdict->nonfinite_pixels > 0) {
    return;
  }
  result.identified = identify_form(one, prepared, candidate, rules, store);
  const bool integrates = hello.is_ours() && prepared.settings.drawn_directions > 0;  // by directions, which its replicas answer for
  if (result.identified.empty() && !one.environment.empty() && !integrates && result.verdict->p99_rel <= most_approximated) {
    result.identified = "environment filtered";
    result.status = Status::Approximation;
    result.message = "light from everywhere is approximated: 99 % of the values are within " + percent(result.verdict->p99_rel) +
                     ", the largest error is " + percent(result.verdict->max_rel);
    return;
  }
  if (result.identified.empty()) {
    return;
  }
  if (hello.takes_settings()) {
    result.message = "draws " + result.identified + " where another form was asked for; " + result.message;
  } else {
    result.status = Status::Approximation;
    result.message = "meets the golden of " + result.identified + ", which the text allows";
  }
}

/// A scene that breaks a rule must not be drawn. Texts ask no viewer but a validator to notice, so others may draw it.
void judge_refusal(const Answer& answer, const Hello& hello, CaseResult& result) {
  if (answer.status == AnswerStatus::Rendered) {
    result.status = hello.is_ours() ? Status::Fail : Status::Approximation;
    result.identified = "out of range";
    result.message = "draws a scene that breaks a rule of its schema";
    return;
  }
  result.status = answer.status == AnswerStatus::Failed ? Status::Pass : status_of(answer.status);
  result.message = answer.message;
}

}  // namespace

VerdictRules own_rules(golden::Precision precision, albedo::AlbedoScaling scaling, bool environment) {
  VerdictRules rules;
  rules.may_be_negative = scaling == albedo::AlbedoScaling::Literal;
  if (precision == golden::Precision::Mediump) {
    // Ten bits leave much open, and near some singularities everything.
    rules.leave_out_unpromised = true;
    rules.most_vague = 1;
  }
  rules.standard_errors = environment ? replica_standard_errors : 0;
  return rules;
}

VerdictRules rules_of(const Case& one, const PreparedCase& prepared, const Hello& hello) {
  VerdictRules rules = own_rules(prepared.settings.precision, prepared.settings.sheen.scaling, !one.environment.empty());
  rules.golden_is_pxr24 = prepared.reference.pxr24;
  rules.candidate_is_srgb8 = hello.encoding == Encoding::Srgb8;
  if (!hello.is_ours()) {
    rules.leave_out_mirrored = true;
    rules.relative_tolerance = foreign_relative_tolerance;
    rules.absolute_tolerance = foreign_absolute_tolerance;
    rules.environment_tolerance = one.environment.empty() ? 0 : foreign_environment_tolerance;
    rules.standard_errors = 0;
  }
  return rules;
}

Status status_of(AnswerStatus status) {
  switch (status) {
    case AnswerStatus::Unsupported:
      return Status::Unsupported;
    case AnswerStatus::Failed:
      return Status::Fail;
    case AnswerStatus::Crash:
      return Status::Crash;
    case AnswerStatus::Timeout:
      return Status::Timeout;
    default:
      return Status::Invalid;
  }
}

std::vector<std::uint8_t> keep_candidate(const fs::path& images, const std::string& name, const fs::path& source,
                                         const image::Image& candidate, int darker) {
  const fs::path exr = images / (name + ".candidate.exr");
  std::error_code error;
  if (!fs::equivalent(source, exr, error)) {
    image::write(exr, candidate);
  }
  return keep_bytes(images / (name + ".candidate.png"), candidate, darker);
}

PreparedCase prepare_case(const Case& one, const GoldenStore& store, const fs::path& scenes, int subpixel_bits, int drawn_directions) {
  PreparedCase prepared;
  prepared.settings = golden_settings(one, one.model, subpixel_bits, drawn_directions);
  try {
    prepared.scene_file = write_scene(one, scenes);
    if (one.refused) {
      return prepared;
    }
    prepared.scene = scene::load_gltf(prepared.scene_file);
    prepared.scene_hash = scene::content_hash(prepared.scene);
    prepared.reference = store.reference(one, prepared.scene, prepared.scene_hash, prepared.settings);
    prepared.problem = prepared.reference.problem;
  } catch (const std::exception& error) {
    prepared.problem = error.what();
  }
  return prepared;
}

CaseResult judge_case(const Case& one, const PreparedCase& prepared, const Answer& answer, const Hello& hello, const GoldenStore& store,
                      const fs::path& images) {
  CaseResult result;
  result.name = one.name;
  result.model = to_string(one.model.visibility) + " " + to_string(one.model.scaling);
  result.width = one.width;
  result.height = one.height;
  result.scene_file = prepared.scene_file;
  result.law = one.law;
  result.seconds = answer.seconds;
  int darker = 0;
  if (!prepared.reference.image.data.empty()) {
    const int stops = stops_too_bright(prepared.reference.image);
    darker = one.environment.empty() && stops < hard_to_see ? 0 : stops;
    keep_golden(images, one.name, prepared.reference.image, darker, result.pictures);
  }
  if (!prepared.problem.empty()) {
    result.message = prepared.problem;
    return result;
  }
  if (one.refused) {
    judge_refusal(answer, hello, result);
    return result;
  }
  if (answer.status != AnswerStatus::Rendered) {
    result.status = status_of(answer.status);
    result.message = answer.message.empty() ? "the viewer says so" : answer.message;
    return result;
  }
  image::Image candidate;
  try {
    candidate = with_standard_errors(image::read(answer.image));
    if (candidate.channel("standard_error.R") >= 0) {
      image::write(answer.image, candidate);  // in the place of every replica
    }
  } catch (const image::Error& error) {
    result.message = std::string("the picture cannot be read: ") + error.what();
    return result;
  }
  result.pictures.candidate = keep_candidate(images, one.name, answer.image, candidate, darker);
  judge_picture(one, prepared, candidate, hello, store, result);
  if (darker > 0) {
    result.message +=
        (result.message.empty() ? "" : "; ") + ("shown " + std::to_string(darker)) + (darker == 1 ? " stop" : " stops") + " darker";
  }
  return result;
}

image::Image paint_ratios(const std::vector<double>& ratios, int width, int height) {
  image::Image painted(width, height, {"R", "G", "B"});
  for (std::size_t i = 0; i < ratios.size(); ++i) {
    const double ratio = ratios[i];
    std::array<double, 3> color = {0, 0, 0};
    if (ratio < 0) {
      color = {0.12, 0.16, 0.30};
    } else if (ratio > 1) {
      // A tenfold error is halfway to white, whatever its size it stays visible.
      const double heat = std::isfinite(ratio) ? 1 - 1 / (1 + std::log10(ratio)) : 1;
      color = {1.0, heat * heat, heat};
    } else {
      color = {0.55 * ratio * ratio, 0.5 * std::sqrt(ratio), 0.06 * ratio};
    }
    for (std::size_t c = 0; c < 3; ++c) {
      painted.data[3 * i + c] = static_cast<float>(color.at(c));
    }
  }
  return painted;
}

}  // namespace sheen::conformance
