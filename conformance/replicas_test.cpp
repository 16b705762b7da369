#include "conformance/replicas.h"

#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace sheen::conformance {
namespace {

image::Image pixel(float r, float g, float b, float a) {
  image::Image one(1, 1, {"R", "G", "B", "A"});
  one.data = {r, g, b, a};
  return one;
}

TEST(Replicas, TellTheirMeanAndHowFarItMayBeOff) {
  std::vector<float> reds = {1.0F, 2.0F, 3.0F, 6.0F};
  std::set<std::uint64_t> seeds;
  const auto draw = [&](std::uint64_t seed) {
    const float red = reds.at(seeds.size());
    seeds.insert(seed);
    return pixel(red, 0.5F, 2.0F * red, 1.0F);
  };
  const image::Image all = draw_replicas(draw, 4, 7);
  EXPECT_EQ(seeds.size(), 4U);
  EXPECT_EQ(seeds.count(0), 0U) << "seed 0 moves no point";
  EXPECT_EQ(all.at(0, 0, all.channel("R")), 3.0F);
  EXPECT_EQ(all.at(0, 0, all.channel("A")), 1.0F);
  EXPECT_EQ(all.at(0, 0, all.channel("replica.4.R")), 6.0F);
  EXPECT_EQ(all.at(0, 0, all.channel("replica.2.B")), 4.0F);
  EXPECT_EQ(all.channel("replica.5.R"), -1);
  const image::Image told = with_standard_errors(all);
  // Squares of what they differ by: 4 + 1 + 0 + 9 = 14, over 3, over 4.
  EXPECT_FLOAT_EQ(told.at(0, 0, told.channel("standard_error.R")), static_cast<float>(std::sqrt(14.0 / 12.0)));
  EXPECT_EQ(told.at(0, 0, told.channel("standard_error.G")), 0.0F);
  EXPECT_FLOAT_EQ(told.at(0, 0, told.channel("standard_error.B")), static_cast<float>(2.0 * std::sqrt(14.0 / 12.0)));
  EXPECT_EQ(told.channel("replica.1.R"), -1);
}

TEST(Replicas, OfOtherSeedsAreOthers) {
  std::set<std::uint64_t> seeds;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    draw_replicas(
        [&](std::uint64_t one) {
          seeds.insert(one);
          return pixel(0, 0, 0, 0);
        },
        environment_replicas, seed);
  }
  EXPECT_EQ(seeds.size(), 100U * environment_replicas);
  draw_replicas(
      [&](std::uint64_t one) {
        EXPECT_NE(one, 0U) << "seed 0 moves no point";
        return pixel(0, 0, 0, 0);
      },
      environment_replicas, (std::uint64_t{1} << 60U) - 1);  // of which the last would be 2^64
}

TEST(Replicas, WhatOneDoesNotKnowNoMeanKnows) {
  int drawn = 0;
  const auto draw = [&](std::uint64_t) {
    ++drawn;
    return pixel(drawn == 3 ? std::numeric_limits<float>::quiet_NaN() : 1.0F, drawn == 5 ? std::numeric_limits<float>::infinity() : 1.0F,
                 1.0F, 1.0F);
  };
  const image::Image told = with_standard_errors(draw_replicas(draw, 16, 0));
  EXPECT_FALSE(std::isfinite(told.at(0, 0, 0)));
  EXPECT_FALSE(std::isfinite(told.at(0, 0, 1)));
  EXPECT_EQ(told.at(0, 0, 2), 1.0F);
}

TEST(Replicas, APictureWithoutThemStaysAsItIs) {
  const image::Image plain = pixel(0.1F, 0.2F, 0.3F, 1.0F);
  EXPECT_EQ(with_standard_errors(plain).channels, plain.channels);
  EXPECT_EQ(with_standard_errors(plain).data, plain.data);
}

TEST(Replicas, NoMoreIsGrantedThanDirectionsMayBringByChance) {
  // 4,096 directions that bring a 4,096th each are off by their Poisson's deviation at the most.
  const double largest = 1.0 / 4096;
  const double most = granted_to_chance(1e30, 1.0, largest);
  EXPECT_NEAR(most, 5.489 / 64 + 14.37 / 4096, 1e-4);
  EXPECT_NEAR(granted_to_chance(0.01, 1.0, largest), 0.01 + 14.37 / 4096, 1e-5) << "what they show, where that is less";
  EXPECT_NEAR(granted_to_chance(0.0, 10 * largest, largest), 14.37 * largest, 1e-5) << "all may have missed ten that were to be expected";
  EXPECT_EQ(granted_to_chance(1.0, 1.0, 0.0), 0.0) << "what no direction brings is off by no chance";
}

TEST(Replicas, ShareTheDirectionsAmongThem) {
  EXPECT_EQ(directions_of_replica(environment_directions), 256);
  EXPECT_EQ(directions_of_replica(5), 1);
}

TEST(Replicas, StandardErrorsAreStudents) {
  // P(|T| > t) of Student's distribution, by 1 / (1 + t^2 / n) = cos^2: 2 integral of c cos^(n-1) from atan(t / sqrt(n)) to a right angle.
  const double n = environment_replicas - 1;
  const double half_turn = std::acos(-1.0);
  const double begin = std::atan(replica_standard_errors / std::sqrt(n));
  constexpr int steps = 20000;
  double tail = 0;
  for (int i = 0; i < steps; ++i) {
    const double at = begin + (0.5 * half_turn - begin) * (i + 0.5) / steps;
    tail += std::pow(std::cos(at), n - 1) * (0.5 * half_turn - begin) / steps;
  }
  tail *= 2 * std::exp(std::lgamma(0.5 * (n + 1)) - std::lgamma(0.5 * n)) / std::sqrt(half_turn);
  const double of_five = std::erfc(5 / std::sqrt(2.0));
  EXPECT_NEAR(tail, of_five, 2e-3 * of_five);
}

}  // namespace
}  // namespace sheen::conformance
