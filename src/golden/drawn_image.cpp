#include "golden/drawn_image.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "golden/environment_light.h"
#include "number/bounded_functions.h"

namespace sheen::golden {
namespace {

/// Where under a tent, from its middle, a number in [0, 1) lies.
double under_tent(double x) {
  return x < 0.5 ? std::sqrt(2 * x) - 1 : 1 - std::sqrt(2 - 2 * x);
}

/// The index in sums[0 .. count] of the part that a share of the whole falls into, and where inside it.
struct Part {
  std::size_t index;
  double within;
};
Part part_of(const double* sums, std::size_t count, double share) {
  const double at = share * sums[count];
  const double* end = std::upper_bound(sums + 1, sums + count, at);
  const auto index = static_cast<std::size_t>(end - sums) - 1;
  const double size = sums[index + 1] - sums[index];
  return {index, size > 0 ? std::clamp((at - sums[index]) / size, 0.0, 1.0 - 0x1p-30) : 0.5};
}

}  // namespace

DrawnImage::DrawnImage(const scene::Environment& environment, const glm::dmat3& view_from_world) : environment_(environment) {
  if (!environment.is_image()) {
    return;
  }
  const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), -environment.rotation, glm::dvec3(0.0, 1.0, 0.0));
  image_from_view_ = glm::dmat3(turned) * glm::transpose(view_from_world);
  const auto w = static_cast<std::size_t>(environment.width);
  const auto h = static_cast<std::size_t>(environment.height);
  const auto brightness = [&](std::size_t x, std::size_t y) {
    const glm::dvec3 texel(environment.texels[y * w + x]);
    return texel.x + texel.y + texel.z;
  };
  row_sums_.assign(h + 1, 0.0);
  texel_sums_.assign(h * (w + 1), 0.0);
  for (std::size_t y = 0; y < h; ++y) {
    const double sine = std::sin(brdf::pi * (static_cast<double>(y) + 0.5) / static_cast<double>(h));
    for (std::size_t x = 0; x < w; ++x) {
      densities_.push_back(brightness(x, y) * sine);
      texel_sums_[y * (w + 1) + x + 1] = texel_sums_[y * (w + 1) + x] + densities_.back();
    }
    row_sums_[y + 1] = row_sums_[y] + texel_sums_[y * (w + 1) + w];
  }
  // d omega = 2 pi^2 sin(theta) du dv. Of a black image every texel has its share; there is nothing to miss.
  const double total = row_sums_.back();
  const double per_texel = static_cast<double>(w * h) / (2.0 * brdf::pi * brdf::pi);
  for (const glm::dvec3& world : brightest_directions(environment)) {
    const glm::dvec3 d = view_from_world * world;
    brightest_.push_back({d.x, d.y, d.z});
  }
  for (double& density : densities_) {
    density = (total > 0 ? density / total : 1.0 / static_cast<double>(w * h)) * per_texel;
  }
}

DrawnImage::Drawn DrawnImage::draw(double u, double v) const {
  const auto w = static_cast<std::size_t>(environment_.width);
  const auto h = static_cast<std::size_t>(environment_.height);
  const Part row = part_of(row_sums_.data(), h, v);
  const Part column = part_of(&texel_sums_[row.index * (w + 1)], w, u);
  // The outer half of the first row and of the last is under no other's tent.
  const bool own = (row.index == 0 && row.within < 0.5) || (row.index == h - 1 && row.within >= 0.5);
  const double x = static_cast<double>(column.index) + 0.5 + under_tent(column.within);
  const double y = static_cast<double>(row.index) + (own ? row.within : 0.5 + under_tent(row.within));
  const scene::Environment upright;
  const glm::dvec3 d = upright.direction({x / static_cast<double>(w), y / static_cast<double>(h)});
  const double density = bilinear(x, y).w / std::max(std::sqrt(d.x * d.x + d.z * d.z), 1e-6);
  // From a texture of floats, then turned to view space by the inverse of the other matrix, which is its transpose.
  const auto held = [](double number) { return Bound::within(number, std::abs(number) * 0x1p-24); };
  const Vec3<Bound> in_image{held(d.x), held(d.y), held(d.z)};
  const auto axis = [&](int k) { return dot(broadcast<Bound>(image_from_view_[k]), in_image); };
  return {{axis(0), axis(1), axis(2)}, held(density)};
}

DrawnImage::Place DrawnImage::place(const Vec3<Bound>& in_image) const {
  const glm::dvec3 d(in_image.x.center(), in_image.y.center(), in_image.z.center());
  const Bound sine = sqrt(max(in_image.x * in_image.x + in_image.z * in_image.z, Bound(1e-30)));
  const Bound u = Bound(0.5) + angle_of(in_image.z, in_image.x) / Bound(2 * brdf::pi);
  const Bound v = angle_of(sine, in_image.y) / Bound(brdf::pi);
  const scene::Environment upright;
  const glm::dvec2 at = upright.coordinates(glm::normalize(d));
  // Scaled to texels they are rounded once more, and halves are taken off.
  const double width = environment_.width;
  const double height = environment_.height;
  return {at.x * width, at.y * height, width * (u.deviation() + angle_error / brdf::pi + 3 * epsilon),
          height * (v.deviation() + angle_error / brdf::pi + 3 * epsilon)};
}

glm::dvec4 DrawnImage::texel(long x, long y) const {
  const long w = environment_.width;
  const long row = std::clamp(y, 0L, static_cast<long>(environment_.height) - 1);
  const auto i = static_cast<std::size_t>(row * w + ((x % w) + w) % w);
  return {glm::dvec3(environment_.texels[i]), densities_[i]};
}

glm::dvec4 DrawnImage::bilinear(double x, double y) const {
  const double left = std::floor(x - 0.5);
  const double top = std::floor(y - 0.5);
  const auto at = [&](long i, long j) { return texel(static_cast<long>(left) + i, static_cast<long>(top) + j); };
  const double across = x - 0.5 - left;
  return glm::mix(glm::mix(at(0, 0), at(1, 0), across), glm::mix(at(0, 1), at(1, 1), across), y - 0.5 - top);
}

DrawnImage::Seen DrawnImage::look_up(const Vec3<Bound>& direction) const {
  if (!environment_.is_image()) {
    const glm::dvec3& uniform = environment_.uniform;
    return {{Bound(uniform.x), Bound(uniform.y), Bound(uniform.z)}, Bound(0.0)};
  }
  const glm::dmat3 rows = glm::transpose(image_from_view_);
  const auto axis = [&](int k) { return dot(broadcast<Bound>(rows[k]), direction); };
  const Vec3<Bound> d{axis(0), axis(1), axis(2)};
  const Place at = place(d);
  if (!std::isfinite(at.dx + at.dy)) {
    const Bound none = Bound::unbounded(0.0);
    return {{none, none, none}, none};
  }
  // Between texel centres it is bilinear: it changes by no more than its steepest slopes over all that may be met.
  glm::dvec4 across(0.0), down(0.0), most(0.0);
  const double dx = std::min(at.dx, static_cast<double>(environment_.width));
  const double dy = std::min(at.dy, static_cast<double>(environment_.height));
  for (auto y = static_cast<long>(std::floor(at.y - 0.5 - dy)); y <= static_cast<long>(std::floor(at.y - 0.5 + dy)); ++y) {
    for (auto x = static_cast<long>(std::floor(at.x - 0.5 - dx)); x <= static_cast<long>(std::floor(at.x - 0.5 + dx)); ++x) {
      for (const long other : {0L, 1L}) {
        across = glm::max(across, glm::abs(texel(x + 1, y + other) - texel(x, y + other)));
        down = glm::max(down, glm::abs(texel(x + other, y + 1) - texel(x + other, y)));
        most = glm::max(most, glm::max(texel(x, y + other), texel(x + 1, y + other)));
      }
    }
  }
  const glm::dvec4 value = bilinear(at.x, at.y);
  // The weights are rounded, and three mixtures of two products each: (1 + epsilon)^9 at the most. Densities reach the shader as floats.
  const glm::dvec4 deviation = at.dx * across + at.dy * down + 10 * epsilon * most;
  const auto within = [&](int c) { return Bound::within(value[c], deviation[c]); };
  const Bound sine2 = max(d.x * d.x + d.z * d.z, Bound(1e-12));
  return {{within(0), within(1), within(2)}, max(within(3), Bound(0.0)) * inversesqrt(sine2)};
}

}  // namespace sheen::golden
