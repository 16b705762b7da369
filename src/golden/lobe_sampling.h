#pragma once

#include <array>
#include <cstddef>

#include <glm/vec3.hpp>

#include "golden/environment_light.h"
#include "golden/shade.h"

namespace sheen::golden {

/// Ways to draw a direction toward the light at a surface: from the image, and from each lobe that the surface has.
class LobeSampling {
 public:
  /// The light must outlive this.
  LobeSampling(const Surface<double>& surface, Layers layers, const EnvironmentLight& light);

  std::size_t strategies() const { return count_; }
  /// A unit direction by one of the strategies for (u, v) in [0, 1)^2; may lie below the surface, where it lights nothing.
  glm::dvec3 sample(std::size_t strategy, double u, double v) const;
  /// Density of one strategy, 1/sr.
  double pdf(std::size_t strategy, const glm::dvec3& direction) const { return pdf(kinds_[strategy], direction); }
  /// Mean density of all strategies, 1/sr: what the balance heuristic divides by when each draws as often.
  double mean_pdf(const glm::dvec3& direction) const;

 private:
  enum class Kind { Image, Cosine, Ggx, CoatGgx, Sheen };
  struct Frame {
    glm::dvec3 t, b, n, v;
  };
  static Frame frame(const LobeView<double>& lobe);
  double pdf(Kind kind, const glm::dvec3& direction) const;

  const EnvironmentLight& light_;
  Frame base_, coat_;
  double alpha_, coat_alpha_, sheen_exponent_ = 0;
  std::array<Kind, 5> kinds_{};
  std::size_t count_ = 0;
};

}  // namespace sheen::golden
