// The formulas of one light at one point, in double: what the golden spends its time in.
#include <array>
#include <cmath>
#include <cstddef>

#include <benchmark/benchmark.h>

#include "brdf/base.h"
#include "brdf/sheen.h"

namespace {

using sheen::brdf::Visibility;

/// Cosines that no compiler can foresee, spread over (0, 1].
class Cosines {
 public:
  Cosines() {
    double x = 0.5;
    for (double& value : values_) {
      x = std::fmod(x + 0.6180339887498949, 1.0);  // the golden ratio's fraction: evenly spread, no two alike
      value = 0.001 + 0.998 * x;
    }
  }
  double next() { return values_[index_++ % values_.size()]; }

 private:
  std::array<double, 1024> values_{};
  std::size_t index_ = 0;
};

void charlie_distribution(benchmark::State& state) {
  Cosines cosines;
  for ([[maybe_unused]] auto step : state) {
    const double n_dot_h = cosines.next();
    benchmark::DoNotOptimize(sheen::brdf::charlie_distribution(0.09, n_dot_h, 1.0 - n_dot_h * n_dot_h));
  }
}
BENCHMARK(charlie_distribution);

void sheen_lobe(benchmark::State& state, Visibility visibility) {
  Cosines cosines;
  const sheen::brdf::SheenLobe<double> lobe(visibility, 0.3, 0.7);
  for ([[maybe_unused]] auto step : state) {
    const double n_dot_h = cosines.next();
    benchmark::DoNotOptimize(lobe.value_times_n_dot_l(cosines.next(), n_dot_h, 1.0 - n_dot_h * n_dot_h));
  }
}
BENCHMARK_CAPTURE(sheen_lobe, charlie, Visibility::Charlie);
BENCHMARK_CAPTURE(sheen_lobe, ashikhmin, Visibility::Ashikhmin);
BENCHMARK_CAPTURE(sheen_lobe, refined, Visibility::Refined);

void ggx_lobe(benchmark::State& state) {
  Cosines cosines;
  for ([[maybe_unused]] auto step : state) {
    const double n_dot_h = cosines.next();
    benchmark::DoNotOptimize(sheen::brdf::ggx_distribution(0.25, n_dot_h, 1.0 - n_dot_h * n_dot_h) *
                             sheen::brdf::smith_visibility(0.25, cosines.next(), 0.7));
  }
}
BENCHMARK(ggx_lobe);

void base_layer(benchmark::State& state) {
  Cosines cosines;
  const sheen::brdf::Base<double> base{{0.8, 0.5, 0.2}, 0.5, 0.25, {0.04, 0.04, 0.04}, 1.0};
  for ([[maybe_unused]] auto step : state) {
    const double n_dot_h = cosines.next();
    benchmark::DoNotOptimize(sheen::brdf::base_brdf(base, cosines.next(), 0.7, n_dot_h, 1.0 - n_dot_h * n_dot_h, cosines.next()));
  }
}
BENCHMARK(base_layer);

}  // namespace
