#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "conformance/case.h"
#include "conformance/diagnosis.h"
#include "conformance/golden_store.h"
#include "conformance/verdict.h"
#include "conformance/viewer.h"

namespace sheen::conformance {

struct FunctionFindings;  // function_findings.h

/// A case, ready to be drawn and judged.
struct PreparedCase {
  std::filesystem::path scene_file;
  scene::Scene scene;
  std::string scene_hash;
  golden::Settings settings;
  Reference reference;
  std::string problem;  ///< why the case cannot be judged; empty when it can
};

/// Pictures of a case for the report, as PNG files in memory; empty where there is none.
struct CasePictures {
  std::vector<std::uint8_t> candidate, golden, difference;
};

/// The picture of one scene of a relation.
struct ScenePicture {
  std::string label;
  std::filesystem::path scene_file;
  std::vector<std::uint8_t> png;  ///< empty when there is none
};

struct CaseResult {
  std::string name;
  Status status = Status::Invalid;
  std::optional<Verdict> verdict;  ///< when pictures were compared
  std::string identified;          ///< the allowed form of the model that the candidate meets, when it fails the one asked for
  double seconds = 0;              ///< the viewer's
  std::string message;
  std::string model;  ///< "charlie full"
  int width = 0, height = 0;
  std::filesystem::path scene_file;
  std::optional<Diagnosis> diagnosis;
  CasePictures pictures;
  std::vector<ScenePicture> scenes;                  ///< of a relation, in the place of candidate and golden
  std::string law;                                   ///< of a relation, with its source
  std::shared_ptr<const FunctionFindings> findings;  ///< of a function, in the place of pictures
};

/// Writes the scene, reads it back, computes the golden; of a case that is to be refused, writes it alone. Never throws: what goes wrong is
/// the case's `problem`. Safe to call from many threads.
/// @param drawn_directions  of golden_settings
PreparedCase prepare_case(const Case& one, const GoldenStore& store, const std::filesystem::path& scenes, int subpixel_bits,
                          int drawn_directions = 0);

/// What viewers of others are granted beyond the bound, a share of the value and an absolute one: half floats in a target or a table hold
/// 11 bits, a share of 5e-4, and tables of albedos in use are off by more.
inline constexpr double foreign_relative_tolerance = 1e-3;
inline constexpr double foreign_absolute_tolerance = 2e-5;
/// And under an environment, which they draw or filter as they please: what some 4,096 directions leave, a share of the value.
inline constexpr double foreign_environment_tolerance = 0.02;

/// What our own viewer is judged by: a golden for that precision and scaling, and whether an environment lights the scene.
VerdictRules own_rules(golden::Precision precision, albedo::AlbedoScaling scaling, bool environment);

/// Judges what the viewer answered and writes the case's pictures to `images`. A candidate that fails is also held against the goldens of
/// the other forms that the text allows (simplified scaling; the simpler visibility): a viewer that cannot be told which form to draw and
/// meets one of those is an approximation; one that can be told fails, and is told what it seems to draw.
CaseResult judge_case(const Case& one, const PreparedCase& prepared, const Answer& answer, const Hello& hello, const GoldenStore& store,
                      const std::filesystem::path& images);

/// What judges a picture of the case.
VerdictRules rules_of(const Case& one, const PreparedCase& prepared, const Hello& hello);

/// What a viewer's answer without a picture makes of a case.
Status status_of(AnswerStatus status);

/// Writes a candidate to images/NAME.candidate.exr (unless the viewer has) and .png, that one `darker` stops darker. Returns the bytes of
/// the latter. Throws image::Error.
std::vector<std::uint8_t> keep_candidate(const std::filesystem::path& images, const std::string& name, const std::filesystem::path& source,
                                         const image::Image& candidate, int darker = 0);

/// The difference as the report paints it: error over bound, dark green to yellow up to 1, red to white above, blue-grey where left out.
image::Image paint_ratios(const std::vector<double>& ratios, int width, int height);

}  // namespace sheen::conformance
