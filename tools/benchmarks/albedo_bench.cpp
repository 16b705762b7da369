// Directional albedo: one quadrature, a table, the interpolant that the golden reads.
#include <vector>

#include <benchmark/benchmark.h>

#include "albedo/directional_albedo.h"
#include "albedo/interpolant.h"
#include "albedo/table.h"

namespace {

using sheen::albedo::Visibility;

void albedo_quadrature(benchmark::State& state, Visibility visibility) {
  double n_dot_v = 0.1;
  for ([[maybe_unused]] auto step : state) {
    n_dot_v = n_dot_v > 0.9 ? 0.1 : n_dot_v + 0.0137;
    benchmark::DoNotOptimize(sheen::albedo::directional_albedo(visibility, n_dot_v, 0.4));
  }
}
BENCHMARK_CAPTURE(albedo_quadrature, charlie, Visibility::Charlie)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(albedo_quadrature, ashikhmin, Visibility::Ashikhmin)->Unit(benchmark::kMicrosecond);

void albedo_grid(benchmark::State& state) {
  std::vector<double> centres;
  centres.reserve(64);
  for (int i = 0; i < 64; ++i) {
    centres.push_back((i + 0.5) / 64.0);
  }
  for ([[maybe_unused]] auto step : state) {
    benchmark::DoNotOptimize(sheen::albedo::evaluate_grid(Visibility::Charlie, centres, centres));
  }
}
BENCHMARK(albedo_grid)->Name("albedo_grid_64x64")->Unit(benchmark::kMillisecond)->UseRealTime();

void albedo_shader_table(benchmark::State& state) {
  for ([[maybe_unused]] auto step : state) {
    benchmark::DoNotOptimize(sheen::albedo::build_table(Visibility::Charlie));
  }
}
BENCHMARK(albedo_shader_table)->Unit(benchmark::kMillisecond)->UseRealTime();

void albedo_interpolant(benchmark::State& state) {
  const sheen::albedo::Interpolant interpolant(Visibility::Charlie);
  double n_dot_v = 0.1;
  for ([[maybe_unused]] auto step : state) {
    n_dot_v = n_dot_v > 0.9 ? 0.1 : n_dot_v + 0.0137;
    benchmark::DoNotOptimize(interpolant(n_dot_v, 0.4));
  }
}
BENCHMARK(albedo_interpolant);

}  // namespace
