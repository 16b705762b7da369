#pragma once

#include <array>
#include <string>
#include <vector>

#include "conformance/case.h"
#include "conformance/sweep.h"

namespace sheen::conformance {

/// How the pictures of a relation's scenes must stand to each other.
enum class RelationKind {
  Equal,     ///< every picture is the first
  Differs,   ///< every other picture differs from the first, over a share of the pixels
  Brighter,  ///< each picture is nowhere darker than the next, and brighter over a share of the pixels
  Linear,    ///< the weighted sum of the pictures is 0: a law of radiance, not of what a tone mapping makes of it
};

/// The word of a suite file: "equal", "differs", "brighter", "linear".
std::string to_string(RelationKind kind);

/// A law that holds between pictures of one viewer, so that no golden is needed. All but Linear hold through any tone mapping that works on
/// each pixel alone; Brighter is asked of greys, whose order every such mapping keeps.
struct Relation {
  std::string name;  ///< dotted, says what must hold: "sheen.color_zero_is_no_sheen"
  RelationKind kind = RelationKind::Equal;
  std::string law;     ///< the rule in a sentence
  std::string source;  ///< the text that says so
  std::vector<Case> scenes;
  std::vector<std::string> labels;  ///< of the scenes
  std::vector<double> weights;      ///< Linear: one a scene
  /// How far a picture may be from what it should be, by part of its value and absolutely, unless the file says otherwise (and why). Our
  /// own viewer's pictures are held to their goldens instead (README, "How a verdict is reached").
  double relative = 1e-3;
  double absolute = 2e-5;
  double share = 0.02;                       ///< Differs, Brighter: of the pixels looked at
  std::array<double, 4> region{0, 0, 1, 1};  ///< left, top, right, bottom as shares of the picture: what is looked at
  bool mirrored = false;                     ///< the pictures after the first are turned left to right before they are compared
  bool moved = false;  ///< the scenes lie otherwise on the pixel grid: edges are left out, and a sample may be a sub-pixel step off
  bool exact = false;  ///< our own viewer's pictures must agree to the bit
  std::string excuse;  ///< why a viewer that cannot be told which form of the model to draw may break the law: it then approximates
};

/// Makes a relation of a sweep's point whose description has a member `relation` (conformance/suites/README.md). Throws SuiteError.
Relation make_relation(SweepPoint point, const std::string& file, const std::string& element);

}  // namespace sheen::conformance
