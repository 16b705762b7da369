// A whole picture of a velvet sphere, 256 x 256, three lights, and light from everywhere beside them: the golden with its bounds, and a
// frame of the renderer. And a small picture of many cloths.
#include <memory>

#include <benchmark/benchmark.h>

#include "gles/context.h"
#include "golden/golden.h"
#include "renderer/renderer.h"
#include "tools/benchmarks/patchwork_scene.h"
#include "tools/benchmarks/sphere_scene.h"

namespace {

constexpr int size = 256;

void golden_picture(benchmark::State& state, bool clearcoat, bool bounds, bool light_from_everywhere) {
  sheen::scene::Environment environment;
  environment.uniform = glm::dvec3(1.0);
  const sheen::scene::Scene scene = sheen::bench::sphere_scene(clearcoat);
  sheen::golden::Settings settings;
  settings.view.width = size;
  settings.view.height = size;
  settings.bounds = bounds;
  settings.environment = light_from_everywhere ? &environment : nullptr;
  for ([[maybe_unused]] auto step : state) {
    benchmark::DoNotOptimize(sheen::golden::render(scene, settings));
  }
  state.counters["pixels"] = benchmark::Counter(size * size, benchmark::Counter::kIsIterationInvariantRate);
}

BENCHMARK_CAPTURE(golden_picture, sheen, false, false, false)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(golden_picture, sheen_with_bounds, false, true, false)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(golden_picture, clearcoat_over_sheen, true, false, false)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(golden_picture, clearcoat_over_sheen_with_bounds, true, true, false)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(golden_picture, in_uniform_light, true, false, true)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(golden_picture, in_uniform_light_with_bounds, true, true, true)->Unit(benchmark::kMillisecond)->UseRealTime();

void golden_patchwork(benchmark::State& state, bool bounds) {
  const sheen::scene::Scene scene = sheen::bench::patchwork_scene();
  sheen::golden::Settings settings;
  settings.view.width = 64;
  settings.view.height = 64;
  settings.bounds = bounds;
  for ([[maybe_unused]] auto step : state) {
    benchmark::DoNotOptimize(sheen::golden::render(scene, settings));
  }
}
BENCHMARK_CAPTURE(golden_patchwork, plain, false)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(golden_patchwork, with_bounds, true)->Unit(benchmark::kMillisecond)->UseRealTime();

void renderer_frame(benchmark::State& state, sheen::gles::ContextKind kind, bool clearcoat) {
  std::unique_ptr<sheen::gles::Context> context;
  try {
    context = sheen::gles::Context::create(kind);
  } catch (const sheen::gles::Unavailable& error) {
    state.SkipWithError(error.what());
    return;
  }
  const sheen::scene::Scene scene = sheen::bench::sphere_scene(clearcoat);
  sheen::renderer::Settings settings;
  settings.view.width = size;
  settings.view.height = size;
  sheen::renderer::Renderer renderer(*context);
  renderer.render(scene, settings);  // compiles the program and builds the table, which later frames keep
  for ([[maybe_unused]] auto step : state) {
    benchmark::DoNotOptimize(renderer.render(scene, settings));
  }
  state.counters["pixels"] = benchmark::Counter(size * size, benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK_CAPTURE(renderer_frame, osmesa_sheen, sheen::gles::ContextKind::OsMesa, false)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(renderer_frame, osmesa_clearcoat_over_sheen, sheen::gles::ContextKind::OsMesa, true)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(renderer_frame, egl_sheen, sheen::gles::ContextKind::Egl, false)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
