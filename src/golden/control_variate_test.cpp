// What of an image's light is integrated without drawing.

#include "golden/control_variate.h"

#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "golden/environment_light.h"
#include "golden/environment_shade.h"
#include "golden/test_scenes.h"
#include "number/cpu.h"

namespace sheen::golden {
namespace {

using Color = brdf::Rgb<double>;

// Rough, and turned so that no column of texels falls on an axis.
scene::Environment patches() {
  scene::Environment e;
  e.width = 48;
  e.height = 24;
  for (int i = 0; i < e.width * e.height; ++i) {
    e.texels.emplace_back(1.0f + static_cast<float>(i * 7919 % 13), static_cast<float>(i * 104729 % 7), 0.25f);
  }
  e.rotation = 0.9;
  return e;
}

// Sum over a grid far finer than the texels, aligned to them: (direction, radiance times solid angle).
template <class Add>
void sum_over(const scene::Environment& e, const Add& add) {
  const int rows = e.height * 24;
  const int columns = e.width * 24;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const glm::dvec2 uv((x + 0.5) / columns, (y + 0.5) / rows);
      const glm::dvec3 d = e.direction(uv);
      add(d, e.radiance(d) * (2.0 * brdf::pi * brdf::pi * std::sin(brdf::pi * uv.y) / (1.0 * rows * columns)));
    }
  }
}

// Turned so that no axis of its frame is one of the image's.
Surface<double> cloth() {
  Surface<double> s = test::cloth_under_lacquer(0.5);
  const glm::dvec3 n = glm::normalize(glm::dvec3(0.3, 0.8, -0.5));
  const glm::dvec3 v = glm::normalize(glm::dvec3(0.5, 0.4, 0.2));
  s.normal = {n.x, n.y, n.z};
  s.view = {v.x, v.y, v.z};
  return s;
}

TEST(BandLimited, HasTheIntegralsOfTheImageAgainstPolynomials) {
  const scene::Environment e = patches();
  const EnvironmentLight light(e);
  ASSERT_TRUE(light.bright().dark());
  const auto powers = [](const glm::dvec3& d) {
    return std::vector<double>{1.0, d.x, d.y, d.z, d.x * d.z, d.y * d.y * d.x, std::pow(d.z, 6), std::pow(d.x, 3) * std::pow(d.y, 3)};
  };
  std::vector<glm::dvec3> of_image(8, glm::dvec3(0.0));
  sum_over(e, [&](const glm::dvec3& d, const glm::dvec3& arriving) {
    const std::vector<double> p = powers(d);
    for (std::size_t i = 0; i < p.size(); ++i) {
      of_image[i] += arriving * p[i];
    }
  });
  // A fine grid for a product of polynomials of degree 12.
  std::vector<glm::dvec3> of_band(8, glm::dvec3(0.0));
  constexpr int rows = 2000;
  constexpr int columns = 32;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const double z = 2.0 * (i + 0.5) / rows - 1.0;
      const double angle = 2.0 * brdf::pi * j / columns;
      const double s = std::sqrt(1.0 - z * z);
      const glm::dvec3 d(s * std::cos(angle), s * std::sin(angle), z);
      const Color c = light.slow().radiance(Vec3<double>{d.x, d.y, d.z});
      const std::vector<double> p = powers(d);
      for (std::size_t k = 0; k < p.size(); ++k) {
        of_band[k] += glm::dvec3(c.r, c.g, c.b) * (p[k] * 4.0 * brdf::pi / (1.0 * rows * columns));
      }
    }
  }
  for (std::size_t k = 0; k < of_image.size(); ++k) {
    EXPECT_NEAR(of_band[k].x, of_image[k].x, 2e-5 * of_image[0].x) << k;
    EXPECT_NEAR(of_band[k].y, of_image[k].y, 2e-5 * of_image[0].y) << k;
    EXPECT_NEAR(of_band[k].z, of_image[k].z, 2e-5 * of_image[0].z) << k;
  }
}

// However few rows it has. Of one colour nothing but that colour is left.
TEST(BandLimited, OfASingleColourIsThatColour) {
  for (const int rows : {1, 2, 3, 5, 40}) {
    for (const int columns : {1, 2, 7}) {
      scene::Environment e;
      e.width = columns;
      e.height = rows;
      e.texels.assign(static_cast<std::size_t>(columns * rows), glm::vec3(0.5f, 2.0f, 0.0f));
      const EnvironmentLight light(e);
      for (const glm::dvec3& d : {glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.6, -0.8, 0.0), glm::normalize(glm::dvec3(0.2, 0.1, -0.9))}) {
        const Color c = light.slow().radiance(Vec3<double>{d.x, d.y, d.z});
        EXPECT_NEAR(c.r, 0.5, 1e-7) << columns << " x " << rows;
        EXPECT_NEAR(c.g, 2.0, 1e-7) << columns << " x " << rows;
        EXPECT_EQ(c.b, 0.0);
      }
    }
  }
}

TEST(ControlVariate, ItsIntegralIsThatOfItsProductWithTheImage) {
  const scene::Environment e = patches();
  const EnvironmentLight light(e);
  const albedo::Interpolant interpolant(albedo::Visibility::Charlie);
  CurveCache curves;
  Lighting lighting;
  const Surface<double> surface = cloth();
  lighting.albedo.curve = curves.at(&interpolant, surface.sheen_roughness);
  const ControlVariate control = control_variate(surface, {true, true}, lighting);
  Color exact{0, 0, 0};
  sum_over(e, [&](const glm::dvec3& d, const glm::dvec3& arriving) {
    exact = exact + control(Vec3<double>{d.x, d.y, d.z}) * Color{arriving.x, arriving.y, arriving.z};
  });
  const Color ours = integral(control, light.slow());
  EXPECT_NEAR(ours.r, exact.r, 3e-5 * exact.r);
  EXPECT_NEAR(ours.g, exact.g, 3e-5 * exact.g);
  EXPECT_NEAR(ours.b, exact.b, 3e-5 * exact.b);
}

// Of a Lambertian surface only the kink at the horizon is left over. A clamped cosine's harmonics are pi, 2 pi/3, pi/4, 0, -pi/24, 0, pi/64
// (Ramamoorthi and Hanrahan 2001, equation 8), and the sum of (2l+1) A_l^2 / (4 pi) over them lacks 50/65536 of its square's integral, 2
// pi/3.
TEST(ControlVariate, IsNearWhatALambertianSurfaceScatters) {
  Surface<double> surface = cloth();
  surface.base = {{1.0, 1.0, 1.0}, 0.0, 0.5, {0.0, 0.0, 0.0}, 0.0};
  const ControlVariate control = control_variate(surface, {}, {});
  double off = 0.0;
  double all = 0.0;
  constexpr int n = 400;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double z = 2.0 * (i + 0.5) / n - 1.0;
      const double angle = 2.0 * brdf::pi * j / n;
      const double s = std::sqrt(1.0 - z * z);
      const Vec3<double> d{s * std::cos(angle), s * std::sin(angle), z};
      const double lambert = std::max(dot(d, surface.normal), 0.0) / brdf::pi;
      off += std::pow(control(d).g - lambert, 2);
      all += lambert * lambert;
    }
  }
  EXPECT_NEAR(std::sqrt(off / all), std::sqrt(50.0 / 65536.0), 0.0005);
}

TEST(ControlVariate, BatchesEqualOneAtATime) {
  if (!number::has_batch()) {
    return;  // this processor runs the other alone
  }
  const scene::Environment e = patches();
  const EnvironmentLight light(e);
  const albedo::Interpolant interpolant(albedo::Visibility::Charlie);
  CurveCache curves;
  const Surface<double> surface = cloth();
  std::vector<double> x, y, z;
  for (std::size_t i = 0; i < control_nodes; ++i) {
    const double cosine = (static_cast<double>(i) + 0.5) / control_nodes;
    x.push_back(std::sqrt(1.0 - cosine * cosine) * std::cos(2.4 * static_cast<double>(i)));
    y.push_back(cosine);
    z.push_back(std::sqrt(1.0 - cosine * cosine) * std::sin(2.4 * static_cast<double>(i)));
  }
  const std::vector<double> one(control_nodes, 1.0);
  const DistantLights lights{x.data(), y.data(), z.data(), one.data(), one.data(), one.data()};
  Lighting lighting;
  lighting.albedo.curve = curves.at(&interpolant, surface.sheen_roughness);
  lighting.distant = &lights;
  const NodeValues a = node_values_scalar(surface, {true, true}, lighting);
  const NodeValues b = node_values_batch(surface, {true, true}, lighting);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < control_nodes; ++i) {
      EXPECT_NEAR(a.value[c][i], b.value[c][i], 1e-10 * a.value[c][i]) << i;
    }
  }
  const ControlVariate control = control_variate(surface, {true, true}, lighting);
  SpherePoints points{};
  for (std::size_t i = 0; i < SpherePoints::count; ++i) {
    points.x[i] = x[i % control_nodes];
    points.y[i] = y[i % control_nodes];
    points.z[i] = z[i % control_nodes];
    points.weight[i] = 0.1;
  }
  const Color p = integral_scalar(control, light.slow(), points);
  const Color q = integral_batch(control, light.slow(), points);
  EXPECT_NEAR(p.g, q.g, 1e-10 * std::abs(p.g));
}

}  // namespace
}  // namespace sheen::golden
