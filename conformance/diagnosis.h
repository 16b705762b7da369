#pragma once

#include <string>
#include <vector>

#include "conformance/verdict.h"
#include "golden/golden.h"
#include "image/image.h"
#include "scene/scene.h"

namespace sheen::conformance {

/// How well one wrong factor on one term of the model would explain a candidate.
struct TermFit {
  std::string term;     ///< "sheen lobe D V", "base or its albedo scale s", "coat weight", "coat lobe", "emission"
  double factor = 1;    ///< what the term would have to be multiplied by
  double residual = 0;  ///< error that is left, root mean square over the pixels looked at, each relative to max(golden, 1e-3)
};

/// What the worst pixel is made of and, where the candidate fails, which term is off.
struct Diagnosis {
  int x = -1;
  int y = -1;
  golden::PixelTerms terms;
  double residual = 0;        ///< as in TermFit, with every factor 1
  std::vector<TermFit> fits;  ///< best first; empty when the candidate passes or nothing can be fitted
  std::string sentence;       ///< the finding in words; empty when there are no fits
};

/// Takes the terms of the worst pixel and, if the verdict is Fail, fits each term's factor to the candidate's RGB at a few of the pixels
/// that are out of bound (least squares; radiance is linear in each factor). Pixels that are not fully covered are passed over: more than
/// one surface may show there.
Diagnosis diagnose(const scene::Scene& scene, const golden::Settings& settings, const image::Image& candidate, const image::Image& golden,
                   const VerdictRules& rules, const Verdict& verdict);

}  // namespace sheen::conformance
