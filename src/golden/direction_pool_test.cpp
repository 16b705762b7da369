#include "golden/direction_pool.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace sheen::golden {
namespace {

scene::Environment grey() {
  scene::Environment e;
  e.width = 2;
  e.height = 1;
  e.texels.assign(2, glm::vec3(1.0F));
  return e;
}

double angle_of(const LobePoints& p, std::uint32_t i) {
  const double turn = std::atan2(p.sine[i], p.cosine[i]) / (2.0 * brdf::pi);
  return turn < 0.0 ? turn + 1.0 : turn;
}

// What makes Sobol's points converge fast, and what Owen's scrambling keeps: any 2^k points from a multiple of 2^k on fill every box of
// 2^-i by 2^-(k-i) exactly once.
TEST(DirectionPool, EveryElementaryBoxHoldsOnePoint) {
  const scene::Environment image = grey();
  const EnvironmentLight light(image);
  const DirectionPool pool(light, 3);
  DirectionPool::LobeBlock scratch;
  for (const std::uint32_t sequence : {0U, 77U, 255U}) {
    for (const std::uint32_t begin : {0U, 32U, 96U, 1U << 20}) {
      for (int i = 0; i <= 5; ++i) {
        const LobePoints p = pool.lobe(sequence, begin, scratch);
        std::set<int> boxes;
        for (std::uint32_t k = 0; k < 32; ++k) {
          const int x = static_cast<int>(std::ldexp(p.u[k], i));
          const int y = static_cast<int>(std::ldexp(angle_of(p, k), 5 - i));
          boxes.insert(x * 32 + y);
        }
        EXPECT_EQ(boxes.size(), 32U) << sequence << ' ' << begin << ' ' << i;
      }
    }
  }
}

// One point of each sequence, over many seeds: uniform and without correlation between sequences.
TEST(DirectionPool, SequencesAreIndependent) {
  const scene::Environment image = grey();
  const EnvironmentLight light(image);
  DirectionPool::LobeBlock scratch;
  constexpr int seeds = 4000;
  double mean = 0.0;
  double square = 0.0;
  double product = 0.0;
  for (int seed = 0; seed < seeds; ++seed) {
    const DirectionPool pool(light, static_cast<std::uint64_t>(seed));
    const double a = pool.lobe(0, 1U << 20, scratch).u[5] - 0.5;
    const double b = pool.lobe(1, 1U << 20, scratch).u[5] - 0.5;
    mean += a / seeds;
    square += a * a / seeds;
    product += a * b / seeds;
  }
  const double sigma = 1.0 / std::sqrt(static_cast<double>(seeds));  // of a mean of unit variance
  EXPECT_NEAR(mean, 0.0, 4.0 * sigma / std::sqrt(12.0));
  EXPECT_NEAR(square, 1.0 / 12.0, 4.0 * sigma * std::sqrt(1.0 / 180.0));
  EXPECT_NEAR(product, 0.0, 4.0 * sigma / 12.0);
}

TEST(DirectionPool, PointsBeyondThoseKeptGoOn) {
  const scene::Environment image = grey();
  const EnvironmentLight light(image);
  const DirectionPool pool(light, 3);
  DirectionPool::LightBlock first;
  DirectionPool::LightBlock second;
  const LightPoint a = *pool.soft(9, (1U << 20) + 7, first);
  EXPECT_EQ(a.x, pool.soft(9, 1U << 20, second)[7].x);
  EXPECT_EQ(pool.soft(9, 32, first), pool.soft(9, 32, second)) << "kept";
  EXPECT_EQ(pool.soft(9, 32, first) + 5, pool.soft(9, 37, second));
}

}  // namespace
}  // namespace sheen::golden
