#pragma once

#include <array>
#include <vector>

#include "albedo/sheen_model.h"
#include "gles/context.h"
#include "image/image.h"
#include "scene/environment.h"

namespace sheen::renderer {

/// A lobe that an environment's image is filtered by.
enum class Kernel { Diffuse, Ggx, SheenCharlie, SheenAshikhmin, SheenRefined };

const char* kernel_name(Kernel kernel);
Kernel sheen_kernel(albedo::Visibility visibility);

/// Part of a filtered image: an equirect for one roughness.
struct FilteredPart {
  double roughness;
  int y, width, height;  ///< in rows from the top; the part begins at column 0
};

/// Where the parts of a kernel's filtered image lie; shaders/environment_prefiltered.glsl says the same.
std::vector<FilteredPart> filtered_parts(Kernel kernel);

/// The image filtered by a kernel at each of its roughnesses: channels R G B, the parts one under the other. Drawn by the context, which
/// must be current. Throws gles::Error.
image::Image prefilter(gles::Context& context, const scene::Environment& environment, Kernel kernel);

}  // namespace sheen::renderer
