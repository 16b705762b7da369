#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>

#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "renderer/renderer.h"
#include "renderer/test_scene.h"

namespace sheen::renderer::test {

inline constexpr double pi = 3.14159265358979324;

/// One context and one renderer for all tests of a suite: making them costs more than a test.
class WithRenderer : public testing::Test {
 public:
  static void SetUpTestSuite() {
    shared().context = gles::Context::create_any(gles::ContextKind::OsMesa);
    shared().renderer = std::make_unique<Renderer>(*shared().context);
  }
  static void TearDownTestSuite() {
    shared().renderer.reset();  // a renderer needs its context to the last
    shared().context.reset();
  }

 protected:
  static image::Image render(const scene::Scene& scene, int size = 8, Settings settings = {}) {
    settings.view.width = size;
    settings.view.height = size;
    return shared().renderer->render(scene, settings);
  }
  /// The red radiance at the middle of the picture.
  static double middle(const scene::Scene& scene, const Settings& settings = {}) {
    const image::Image picture = render(scene, 9, settings);
    return static_cast<double>(picture.at(4, 4, 0));
  }

 private:
  struct Shared {
    std::unique_ptr<gles::Context> context;
    std::unique_ptr<Renderer> renderer;
  };
  static Shared& shared() {
    static Shared one;
    return one;
  }
};

}  // namespace sheen::renderer::test
