#pragma once

#include "brdf/albedo_scaling.h"
#include "brdf/model.h"
#include "brdf/sheen.h"

namespace sheen::albedo {

using brdf::AlbedoScaling;
using brdf::Model;
using brdf::Visibility;

/// N.V below this counts as this, in the golden and in the shader alike: Charlie's V has no value at N.V = 0. Small enough that a
/// 4096-pixel-wide sphere meets it on fewer than one pixel in a million.
inline constexpr double min_n_dot_v = 1e-4;

/// The text that is followed, and the choices it leaves open about sheen.
struct SheenModel {
  Visibility visibility = Visibility::Charlie;
  AlbedoScaling scaling = AlbedoScaling::Full;
  Model model = Model::Ratified;
};

/// The model with what its text leaves no choice in: the draft of 2019 knows the Ashikhmin visibility alone and no albedo scaling.
inline SheenModel resolved(SheenModel model) {
  if (model.model == Model::Draft2019) {
    model.visibility = Visibility::Ashikhmin;
    model.scaling = AlbedoScaling::None;
  }
  return model;
}

}  // namespace sheen::albedo
