#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "albedo/sheen_model.h"
#include "golden/sampling_goal.h"
#include "image/image.h"
#include "scene/environment.h"
#include "scene/scene.h"
#include "scene/view.h"

namespace sheen::golden {

/// Changes with every change of a formula that can change a golden; part of the key of every cached or committed golden.
inline constexpr const char* formula_version = "15";

/// The precision that a shader's lobes and Fresnel terms have; all else is highp.
enum class Precision { Highp, Mediump };

struct Settings {
  scene::View view;
  albedo::SheenModel sheen;
  /// SUBPIXEL_BITS of the driver the golden is to judge: its grid may move a sample by 2^-bits pixel along each axis (OpenGL ES 3.0.6,
  /// section 6.2, table 6.29: at least 4).
  int subpixel_bits = 8;
  Precision precision = Precision::Highp;           ///< of the shader the golden is to judge: its bounds
  const scene::Environment* environment = nullptr;  ///< light from everywhere, besides the scene's lights; must outlive its use
  SamplingGoal sampling;                            ///< of an environment that is an image
  bool bounds = true;                               ///< whether to compute the bound channels
  /// Of an environment that the shader integrates from drawn directions, as ours do (shaders/environment_sampled.glsl): how many it adds
  /// up. Its roundings are then part of the bound. 0: another way, of which nothing is known.
  int drawn_directions = 0;
  /// Called now and then with the share done in [0, 1], from any thread.
  std::function<void(double)> progress;
};

/// Renders the truth: channels R G B A and, with bounds, bound.R bound.G bound.B (absolute, in the unit of R), `excluded` (1 where
/// rasterisation may rightly show another surface or none: a sample moved by the sub-pixel step meets other coverage or another depth, or
/// a triangle seen edge on of which the rules promise nothing; 2 where an alpha mask may rightly fall either way; 3, under an environment,
/// where a texture without mipmaps is seen from so far that the step spans half a texel; 4 where the rules promise nothing), `mirrored`,
/// and bound.A of the coverage. With Settings::drawn_directions also direction.R .G .B, the most of the radiance that one of them brings,
/// as far as a few of them tell. Under an image also standard_error.R .G .B of the radiance, of which the bound holds five, and what all
/// may have missed. Where `excluded` is 1 there is no bound: its channels are 0, but for such chance. `mirrored` is 1 where N.V <= 0
/// mirrored V in a lobe (README, "How a verdict is reached"), which other viewers may treat otherwise. Deterministic whatever the number of
/// threads. Throws scene::Error, std::runtime_error if Embree cannot work.
image::Image render(const scene::Scene& scene, const Settings& settings);

/// The factors a term of the model is multiplied by, 1 each by default: what a report varies to say which term a viewer has wrong.
struct TermFactors {
  double distribution = 1, visibility = 1, scale = 1, coat_weight = 1, coat_lobe = 1, base = 1, emission = 1;
};

/// One light's part in a pixel.
struct LightTerms {
  int light = 0;
  double n_dot_l = 0, n_dot_h = 0;
  double d = 0;                           ///< sheen distribution, 1/sr
  double v = 0;                           ///< sheen visibility, 1/sr (times N.L)
  double e_l = 0;                         ///< E(N.L)
  double scale = 1;                       ///< albedo scale s
  double coat_lobe = 0;                   ///< D_c Vis_c, 1/sr
  glm::dvec3 sheen{0}, base{0}, coat{0};  ///< radiance each layer adds, all factors applied
};

/// What a pixel's value is made of.
struct PixelTerms {
  bool covered = false;
  std::string material;
  glm::dvec3 radiance{0}, emission{0};
  double n_dot_v = 0, e_v = 0, coat_weight = 0;
  glm::dvec3 base_color{0}, sheen_color{0};
  double metallic = 0, roughness = 0, sheen_roughness = 0, clearcoat = 0, clearcoat_roughness = 0;
  std::vector<LightTerms> lights;
};

struct Frame;

/// A scene made ready to be asked for the terms of its pixels.
class Probe {
 public:
  /// The arguments must outlive this. Throws as render().
  Probe(const scene::Scene& scene, const Settings& settings);
  ~Probe();

  /// The terms at the centre of pixel (x, y), rows from the top, of the nearest surface.
  PixelTerms terms(int x, int y, const TermFactors& factors = {}) const;

 private:
  std::unique_ptr<const Frame> frame_;
};

}  // namespace sheen::golden
