#include "golden/lights.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace sheen::golden {

std::vector<PreparedLight> prepare_lights(const std::vector<scene::Light>& lights) {
  std::vector<PreparedLight> prepared;
  prepared.reserve(lights.size());
  for (const scene::Light& light : lights) {
    PreparedLight p;
    p.type = light.type;
    p.intensity = light.color * light.intensity;
    p.position = light.position;
    p.axis = light.direction;
    p.inverse_range = std::isfinite(light.range) && light.range > 0.0 ? 1.0 / light.range : 0.0;
    p.cone_cos_outer = std::cos(light.outer_cone);
    p.cone_scale = 1.0 / std::max(0.001, std::cos(light.inner_cone) - p.cone_cos_outer);
    prepared.push_back(p);
  }
  return prepared;
}

}  // namespace sheen::golden
