#include "conformance/diagnosis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace sheen::conformance {
namespace {

/// Enough pixels that terms of different shape part, few enough to be quick.
constexpr std::size_t pixels_looked_at = 6;

struct Term {
  const char* name;
  double golden::TermFactors::*factor;
};

/// D and V only ever appear as their product, and so do the base and its scale: one factor stands for both.
constexpr std::array<Term, 5> probed_terms = {{{"sheen lobe D V", &golden::TermFactors::distribution},
                                               {"base or its albedo scale s", &golden::TermFactors::base},
                                               {"coat weight", &golden::TermFactors::coat_weight},
                                               {"coat lobe", &golden::TermFactors::coat_lobe},
                                               {"emission", &golden::TermFactors::emission}}};

struct Pixel {
  int x = 0;
  int y = 0;
  double ratio = 0;
  glm::dvec3 candidate{0};
  glm::dvec3 radiance{0};  ///< of the golden
  glm::dvec3 weight{0};    ///< 1 / max(golden, 1e-3)
};

glm::dvec3 rgb_at(const image::Image& image, int x, int y) {
  return {image.at(x, y, image.channel("R")), image.at(x, y, image.channel("G")), image.at(x, y, image.channel("B"))};
}

/// Some of the pixels out of bound, from the worst on, spread over all of them.
std::vector<Pixel> pick_pixels(const image::Image& candidate, const image::Image& golden, const VerdictRules& rules) {
  const std::vector<double> ratios = ratio_map(candidate, golden, rules);
  const int alpha = golden.channel("A");
  std::vector<Pixel> off;
  for (int y = 0; y < golden.height; ++y) {
    for (int x = 0; x < golden.width; ++x) {
      const double ratio = ratios[static_cast<std::size_t>(y) * static_cast<std::size_t>(golden.width) + static_cast<std::size_t>(x)];
      if (ratio > 1 && std::isfinite(ratio) && golden.at(x, y, alpha) == 1.0F) {
        off.push_back({x, y, ratio, rgb_at(candidate, x, y), {}, {}});
      }
    }
  }
  std::stable_sort(off.begin(), off.end(), [](const Pixel& a, const Pixel& b) { return a.ratio > b.ratio; });
  if (off.size() <= pixels_looked_at) {
    return off;
  }
  std::vector<Pixel> picked;
  for (std::size_t i = 0; i < pixels_looked_at; ++i) {
    picked.push_back(off[i * (off.size() - 1) / (pixels_looked_at - 1)]);
  }
  return picked;
}

double residual_of(const std::vector<Pixel>& pixels, const std::vector<glm::dvec3>& slopes, double factor) {
  double sum = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const Pixel& pixel = pixels[i];
    const glm::dvec3 left = pixel.candidate - pixel.radiance - (factor - 1) * (slopes.empty() ? glm::dvec3(0) : slopes[i]);
    for (int c = 0; c < 3; ++c) {
      sum += left[c] * left[c] * pixel.weight[c] * pixel.weight[c];
    }
  }
  return std::sqrt(sum / (3.0 * static_cast<double>(std::max<std::size_t>(pixels.size(), 1))));
}

/// Radiance is affine in the factor, L(f) = L(1) + (f-1)(L(1) - L(0)), so weighted least squares has a closed form:
/// f - 1 = sum w^2 (candidate - L(1)) slope / sum w^2 slope^2.
bool fit_term(const golden::Probe& probe, const std::vector<Pixel>& pixels, const Term& term, TermFit& fit) {
  golden::TermFactors without;
  without.*term.factor = 0;
  std::vector<glm::dvec3> slopes;
  double above = 0;
  double below = 0;
  for (const Pixel& pixel : pixels) {
    const glm::dvec3 slope = pixel.radiance - probe.terms(pixel.x, pixel.y, without).radiance;
    slopes.push_back(slope);
    for (int c = 0; c < 3; ++c) {
      const double w2 = pixel.weight[c] * pixel.weight[c];
      above += w2 * (pixel.candidate[c] - pixel.radiance[c]) * slope[c];
      below += w2 * slope[c] * slope[c];
    }
  }
  // A term of less than a millionth of the radiance could be anything.
  if (!(below > 1e-12 * static_cast<double>(pixels.size()))) {
    return false;
  }
  fit.term = term.name;
  fit.factor = 1 + above / below;
  fit.residual = residual_of(pixels, slopes, fit.factor);
  return true;
}

std::string describe(const Diagnosis& diagnosis) {
  const TermFit& best = diagnosis.fits.front();
  std::array<char, 256> text{};
  // A factor that takes away nine tenths of the error explains it; a tie between terms would show as close residuals in the list.
  if (best.residual <= 0.1 * diagnosis.residual) {
    std::snprintf(text.data(), text.size(), "%s is off by a factor of %.4g (leaves %.2g of %.2g relative error)", best.term.c_str(),
                  best.factor, best.residual, diagnosis.residual);
  } else {
    std::snprintf(text.data(), text.size(), "no single factor explains it; nearest: %s times %.4g (leaves %.2g of %.2g relative error)",
                  best.term.c_str(), best.factor, best.residual, diagnosis.residual);
  }
  return text.data();
}

}  // namespace

Diagnosis diagnose(const scene::Scene& scene, const golden::Settings& settings, const image::Image& candidate, const image::Image& golden,
                   const VerdictRules& rules, const Verdict& verdict) {
  Diagnosis diagnosis;
  if (verdict.worst_x < 0) {
    return diagnosis;
  }
  diagnosis.x = verdict.worst_x;
  diagnosis.y = verdict.worst_y;
  const golden::Probe probe(scene, settings);
  diagnosis.terms = probe.terms(diagnosis.x, diagnosis.y);
  if (verdict.status != Status::Fail) {
    return diagnosis;
  }
  std::vector<Pixel> pixels;
  for (Pixel& pixel : pick_pixels(candidate, golden, rules)) {
    const golden::PixelTerms made_of = probe.terms(pixel.x, pixel.y);
    if (!made_of.covered) {
      continue;
    }
    pixel.radiance = made_of.radiance;
    for (int c = 0; c < 3; ++c) {
      pixel.weight[c] = 1 / std::max(std::abs(pixel.radiance[c]), 1e-3);
    }
    pixels.push_back(pixel);
  }
  if (pixels.empty()) {
    return diagnosis;
  }
  diagnosis.residual = residual_of(pixels, {}, 1);
  for (const Term& term : probed_terms) {
    TermFit fit;
    if (fit_term(probe, pixels, term, fit)) {
      diagnosis.fits.push_back(fit);
    }
  }
  std::stable_sort(diagnosis.fits.begin(), diagnosis.fits.end(),
                   [](const TermFit& a, const TermFit& b) { return a.residual < b.residual; });
  if (!diagnosis.fits.empty()) {
    diagnosis.sentence = describe(diagnosis);
  }
  return diagnosis;
}

}  // namespace sheen::conformance
