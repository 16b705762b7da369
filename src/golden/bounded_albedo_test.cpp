#include "golden/bounded_albedo.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "albedo/interpolant.h"
#include "number/bounded_functions.h"

// E and the physical model's albedos over ranges of their arguments: all that they are in between lies in the bound.

namespace sheen::golden {
namespace {

using Reader = AlbedoReader<Bound>;

/// A range between `from` and 1, narrow or wide, small or large.
Bound some_range(double from, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const double center = from * std::pow(1 / from, unit(random));
  const double reach = std::pow(10.0, -3.0 * unit(random));
  const double lower = std::max(from, center * (1 - reach));
  const double upper = std::min(1.0, center * (1 + 3 * reach));
  return Bound::within(0.5 * (lower + upper), 0.5 * (upper - lower));
}

/// At a place of a range, from 0 to 1.
double at(const Bound& x, double place) {
  return x.range().lower + place * (x.range().upper - x.range().lower);
}

/// @param off  what a shader that reads it from a table may be off
void expect_held(const Bound& bound, double exact, double off, const Bound& cosine, const Bound& roughness) {
  const auto said = [&] {
    return ::testing::Message() << cosine.range().lower << " to " << cosine.range().upper << ", roughness " << roughness.range().lower
                                << " to " << roughness.range().upper;
  };
  const double least = std::max(exact - off, 0.0);
  const double most = exact + off;
  ASSERT_GE(least, bound.range().lower - 1e-12) << said();
  ASSERT_LE(most, bound.range().upper + 1e-12) << said();
  ASSERT_GE(least, bound.center() - bound.radius() - 1e-12) << said();
  ASSERT_LE(most, bound.center() + bound.radius() + 1e-12) << said();
}

constexpr int places = 40;

TEST(BoundedAlbedo, HoldsEOfAllCosinesAndRoughnesses) {
  std::mt19937 random(5);
  for (const brdf::Visibility visibility : brdf::visibilities) {
    const albedo::Interpolant e(visibility);
    SheenAlbedo albedo;
    albedo.interpolant = &e;
    for (int i = 0; i < 300 && !HasFailure(); ++i) {
      const Bound cosine = some_range(albedo::min_n_dot_v, random);
      const Bound roughness = some_range(0.02, random);
      const Bound bound = Reader::Sheen(albedo, roughness)(cosine);
      for (int c = 0; c <= places; ++c) {
        for (int r = 0; r <= places; r += 4) {
          const double n_dot_v = at(cosine, 1.0 * c / places);
          const double sheen_roughness = at(roughness, 1.0 * r / places);
          const double exact = e(n_dot_v, sheen_roughness);
          expect_held(bound, exact, albedo::lookup_error(exact, n_dot_v, sheen_roughness), cosine, roughness);
        }
      }
    }
  }
}

// Toward grazing E is to be seen down to a roughness of 7e-6, and rises from nothing to its peak within a ratio of e.
TEST(BoundedAlbedo, HoldsEOfTheSmallestRoughnesses) {
  std::mt19937 random(10);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const brdf::Visibility visibility : brdf::visibilities) {
    const albedo::Interpolant e(visibility);
    SheenAlbedo albedo;
    albedo.interpolant = &e;
    for (int i = 0; i < 2000 && !HasFailure(); ++i) {
      const double lower = i % 10 == 0 ? 0.0 : 1e-7 * std::pow(1e7, unit(random));
      const double upper = std::min(1.0, std::max(lower, 1e-6) * (1.06 + std::pow(1e5, unit(random)) - 1));
      const Bound roughness = Bound::within(0.5 * (lower + upper), 0.5 * (upper - lower));
      const Bound cosine = some_range(albedo::min_n_dot_v, random);
      const Bound bound = Reader::Sheen(albedo, roughness)(cosine);
      for (int c = 0; c <= places; c += 2) {
        for (int r = 0; r <= places; ++r) {
          const double n_dot_v = at(cosine, 1.0 * c / places);
          const double from = std::max(roughness.range().lower, 1e-8);
          const double sheen_roughness = from * std::pow(roughness.range().upper / from, 1.0 * r / places);
          const double exact = e(n_dot_v, sheen_roughness);
          expect_held(bound, exact, albedo::lookup_error(exact, n_dot_v, sheen_roughness), cosine, roughness);
        }
      }
    }
  }
}

TEST(BoundedAlbedo, HoldsEOfOneRoughnessAtAllCosines) {
  std::mt19937 random(6);
  for (const brdf::Visibility visibility : brdf::visibilities) {
    const albedo::Interpolant e(visibility);
    for (const double sheen_roughness : {0.05, 0.3, 0.5, 1.0}) {
      const Bound roughness(sheen_roughness);
      const AlbedoAround around(e, roughness);
      SheenAlbedo albedo;
      albedo.interpolant = &e;
      albedo.around = &around;
      for (int i = 0; i < 300 && !HasFailure(); ++i) {
        const Bound cosine = some_range(albedo::min_n_dot_v, random);
        const Bound bound = Reader::Sheen(albedo, roughness)(cosine);
        for (int c = 0; c <= places; ++c) {
          const double n_dot_v = at(cosine, 1.0 * c / places);
          const double exact = e(n_dot_v, sheen_roughness);
          expect_held(bound, exact, albedo::lookup_error(exact, n_dot_v, sheen_roughness), cosine, roughness);
        }
      }
    }
  }
}

TEST(BoundedAlbedo, HoldsThePhysicalModels) {
  std::mt19937 random(7);
  const albedo::GgxInterpolant ggx;
  for (int i = 0; i < 300 && !HasFailure(); ++i) {
    const Bound cosine = some_range(albedo::min_n_dot_v, random);
    const Bound alpha = some_range(i % 4 == 0 ? 1e-10 : 1e-3, random);
    const brdf::LobeAlbedo<Bound> bound = Reader::Ggx({&ggx, nullptr}, alpha)(cosine);
    for (int c = 0; c <= places; ++c) {
      for (int r = 0; r <= places; r += 4) {
        const brdf::LobeAlbedo<double> exact = ggx(at(cosine, 1.0 * c / places), at(alpha, 1.0 * r / places));
        expect_held(bound.loss, exact.loss, 0.95 * albedo::ggx_table_error * exact.loss, cosine, alpha);
        expect_held(bound.bias, exact.bias, 0.95 * albedo::ggx_table_error, cosine, alpha);
      }
    }
  }
}

TEST(BoundedAlbedo, HoldsThePhysicalModelsAverages) {
  std::mt19937 random(9);
  const albedo::GgxInterpolant ggx;
  for (int i = 0; i < 300 && !HasFailure(); ++i) {
    const Bound alpha = some_range(i % 4 == 0 ? 1e-10 : 1e-3, random);
    const brdf::LobeAlbedo<Bound> bound = Reader::Ggx({&ggx, nullptr}, alpha).average();
    double least = 1;
    double most = 0;
    for (int r = 0; r <= places; ++r) {
      const brdf::LobeAlbedo<double> exact = ggx.average(at(alpha, 1.0 * r / places));
      expect_held(bound.loss, exact.loss, albedo::ggx_table_error * exact.loss, Bound(1), alpha);
      expect_held(bound.bias, exact.bias, albedo::ggx_table_error, Bound(1), alpha);
      least = std::min(least, exact.loss);
      most = std::max(most, exact.loss);
    }
    if (alpha.range().upper < 2 * alpha.range().lower) {
      EXPECT_LE(bound.loss.range().upper - bound.loss.range().lower, 1.5 * (most - least) + 3 * albedo::ggx_table_error * most)
          << "and hardly more, alpha " << alpha.range().lower << " to " << alpha.range().upper;
    }
  }
}

// Of alphas that a shader may hold of one roughness, and of some farther off.
TEST(BoundedAlbedo, HoldsThePhysicalModelsAboutOneAlpha) {
  std::mt19937 random(8);
  const albedo::GgxInterpolant ggx;
  // 9.95e-5 may be a mirror or not.
  for (const double roughness : {0.0, 5e-5, 9.95e-5, 2e-4, 0.01, 0.03, 0.1, 0.3, 0.6, 1.0}) {
    for (const double reach : {0x1p-23, 1e-3}) {
      const Bound alpha = Bound::within(roughness * roughness, reach * roughness * roughness);
      const GgxAround around = ggx_around(ggx, alpha);
      int narrow = 0;
      for (int i = 0; i < 100 && !HasFailure(); ++i) {
        const Bound cosine = some_range(albedo::min_n_dot_v, random);
        const brdf::LobeAlbedo<Bound> bound = Reader::Ggx({&ggx, &around}, alpha)(cosine);
        for (int c = 0; c <= places; ++c) {
          for (const double end : {0.0, 1.0}) {
            const brdf::LobeAlbedo<double> exact = ggx(at(cosine, 1.0 * c / places), std::min(at(alpha, end), 1.0));
            expect_held(bound.loss, exact.loss, albedo::ggx_table_error * exact.loss, cosine, alpha);
            expect_held(bound.bias, exact.bias, albedo::ggx_table_error, cosine, alpha);
          }
        }
        if (cosine.range().upper < 1.01 * cosine.range().lower && reach < 1e-6) {
          EXPECT_LE(bound.bias.deviation() - std::abs(bound.bias.shift_x()), 0.02) << "and hardly more";
          ++narrow;
        }
      }
      EXPECT_TRUE(narrow > 5 || reach > 1e-6);
    }
  }
}

// Around an alpha of highp, what a shader makes of it in mediump.
TEST(BoundedAlbedo, HoldsThePhysicalModelsInMediump) {
  using Medium = number::Bounded<number::Mediump>;
  const albedo::GgxInterpolant ggx;
  for (const double roughness : {5e-5, 0.03, 0.2, 0.9}) {
    const GgxAround around = ggx_around(ggx, Bound(roughness) * Bound(roughness));
    const Medium alpha = Medium::within(roughness * roughness, 0x1p-10 * roughness * roughness);
    for (const double cosine : {0.02, 0.2, 0.5, 1.0}) {
      const Medium of(cosine);
      const brdf::LobeAlbedo<Medium> bound = AlbedoReader<Medium>::Ggx({&ggx, &around}, alpha)(of);
      const brdf::LobeAlbedo<Medium> average = AlbedoReader<Medium>::Ggx({&ggx, &around}, alpha).average();
      for (const double end : {alpha.range().lower, alpha.range().upper}) {
        const auto holds = [](const Medium& x, double exact, double off) {
          EXPECT_LE(x.range().lower, std::max(exact - off, 0.0));
          EXPECT_GE(x.range().upper, exact + off);
        };
        const brdf::LobeAlbedo<double> exact = ggx(cosine, end);
        holds(bound.loss, exact.loss, albedo::ggx_table_error * exact.loss);
        holds(bound.bias, exact.bias, albedo::ggx_table_error);
        holds(average.loss, ggx.average(end).loss, albedo::ggx_table_error * ggx.average(end).loss);
      }
    }
  }
}

// A cosine that is cut off at one end has its centre there, which does not tell how an albedo bends.
TEST(BoundedAlbedo, HoldsCosinesWhoseCentreIsAtAnEnd) {
  const albedo::GgxInterpolant ggx;
  const albedo::Interpolant e(brdf::Visibility::Charlie);
  SheenAlbedo albedo;
  albedo.interpolant = &e;
  // Past where the loss is largest, and up to 1.
  for (int i = 0; i < 40; ++i) {
    const auto upper = static_cast<float>(0.41 + 0.59 * i / 39);
    const Bound cosine = min(Bound::within(upper, 0.06 * upper), Bound(upper));
    ASSERT_EQ(cosine.center(), cosine.range().upper);
    const Bound alpha(0.375);
    const brdf::LobeAlbedo<Bound> of_ggx = Reader::Ggx({&ggx, nullptr}, alpha)(cosine);
    const Bound of_sheen = Reader::Sheen(albedo, alpha)(cosine);
    for (int c = 0; c <= places; ++c) {
      const double n_dot_v = at(cosine, 1.0 * c / places);
      const brdf::LobeAlbedo<double> exact = ggx(n_dot_v, alpha.center());
      expect_held(of_ggx.loss, exact.loss, albedo::ggx_table_error * exact.loss, cosine, alpha);
      expect_held(of_ggx.bias, exact.bias, albedo::ggx_table_error, cosine, alpha);
      expect_held(of_sheen, e(n_dot_v, 0.375), albedo::lookup_error(e(n_dot_v, 0.375), n_dot_v, 0.375), cosine, alpha);
    }
  }
}

TEST(BoundedAlbedo, OfThePhysicalModelAreNoMoreThanWhatDecadesOfAlphaAreGiven) {
  const albedo::GgxInterpolant ggx;
  double loss = 0;
  double bias = 0;
  for (int a = 0; a <= 180; ++a) {
    const double alpha = std::pow(10.0, -9 * a / 180.0);
    double most = 0;
    for (int c = 0; c <= 200; ++c) {
      const double cosine = std::pow(10.0, -4 * c / 200.0);
      most = std::max(most, ggx(cosine, alpha).loss);
      bias = std::max(bias, ggx(cosine, alpha).bias - std::pow(1 - cosine, 5));
    }
    EXPECT_LT(most, 0.11 + 0.59 * alpha);
    loss = std::max(loss, most / (0.11 + 0.59 * alpha));
    EXPECT_LE(ggx.average(alpha).loss, most);
    EXPECT_LT(ggx.average(alpha).bias, 1.0 / 21 + 0.005);
  }
  EXPECT_GT(loss, 0.95) << "and some come near it";
  EXPECT_LT(bias, 0.005);
  EXPECT_GT(bias, 0.002);
}

TEST(BoundedAlbedo, OfThePhysicalModelChangeNoMoreWithAlphaThanIsCounted) {
  const albedo::GgxInterpolant ggx;
  double loss = 0;
  double bias = 0;
  for (int a = 0; a < 120; ++a) {
    const double alpha = std::pow(10.0, -8 * a / 120.0);
    for (int c = 0; c <= 60; ++c) {
      const double cosine = std::pow(10.0, -4 * c / 60.0);
      const double share = 0.01;
      const auto here = ggx(cosine, alpha);
      const auto there = ggx(cosine, alpha * (1 - share));
      loss = std::max(loss, std::abs(there.loss / here.loss - 1) / share);
      bias = std::max(bias, std::abs(there.bias - here.bias) / share);
    }
  }
  EXPECT_LT(loss, changes_with_alpha);
  EXPECT_GT(loss, 1.5) << "and the figure is not beside the matter";
  EXPECT_LT(bias, changes_with_alpha);
}

TEST(BoundedAlbedo, OfThePhysicalModelBendNoMoreBetweenTwoCosinesThanIsCounted) {
  const albedo::GgxInterpolant ggx;
  double loss = 0;
  double bias = 0;
  constexpr double share = narrow_cosines;
  for (int a = 0; a < 160; ++a) {
    const double alpha = std::pow(10.0, -8 * a / 160.0);
    for (int c = 0; c <= 400; ++c) {
      const double cosine = std::pow(10.0, -4 * c / 400.0) / (1 + share);
      const auto lower = ggx(cosine, alpha);
      const auto middle = ggx(cosine * (1 + 0.5 * share), alpha);
      const auto upper = ggx(cosine * (1 + share), alpha);
      loss = std::max(loss, std::abs(lower.loss + upper.loss - 2 * middle.loss) / (2 * middle.loss));
      bias = std::max(bias, std::abs(lower.bias + upper.bias - 2 * middle.bias) / 2);
    }
  }
  EXPECT_LT(loss, GgxRange<Bound>::loss_bends * share * share);
  EXPECT_GT(loss, 0.2 * GgxRange<Bound>::loss_bends * share * share) << "and the figure is not beside the matter";
  EXPECT_LT(bias, GgxRange<Bound>::bias_bends * share * share);
  EXPECT_GT(bias, 0.2 * GgxRange<Bound>::bias_bends * share * share);
}

TEST(BoundedAlbedo, EBendsNoMoreBetweenTwoCosinesThanIsCounted) {
  double most = 0;
  for (const brdf::Visibility visibility : brdf::visibilities) {
    const albedo::Interpolant e(visibility);
    for (int a = 0; a < 120; ++a) {
      const double sheen_roughness = std::pow(7e-6, a / 119.0);
      for (int c = 0; c <= 400; ++c) {
        const double cosine = std::pow(10.0, -4 * c / 400.0) / (1 + narrow_cosines);
        const double lower = e(cosine, sheen_roughness);
        const double middle = e(cosine * (1 + 0.5 * narrow_cosines), sheen_roughness);
        const double upper = e(cosine * (1 + narrow_cosines), sheen_roughness);
        most = std::max(most, std::abs(lower + upper - 2 * middle) / (2 * std::max(1.0, middle)));
      }
    }
  }
  EXPECT_LT(most, SheenRange<Bound>::e_bends * narrow_cosines * narrow_cosines);
  EXPECT_GT(most, 0.2 * SheenRange<Bound>::e_bends * narrow_cosines * narrow_cosines) << "and the figure is not beside the matter";
}

TEST(BoundedAlbedo, OfThePhysicalModelChangeNoMoreWithBothArgumentsThanIsCounted) {
  const albedo::GgxInterpolant ggx;
  double loss = 0;
  double bias = 0;
  constexpr double share = 0.01;
  for (int a = 0; a < 120; ++a) {
    const double alpha = std::pow(GgxRange<Bound>::least_alpha_of_changes, a / 119.0) * (1 - share);
    for (int c = 0; c <= 120; ++c) {
      const double cosine = std::pow(10.0, -4 * c / 120.0) * (1 - share);
      const auto here = ggx(cosine, alpha);
      for (const double along : {-share, share}) {
        for (const double across : {-share, share}) {
          const auto one = ggx(cosine * (1 + along), alpha);
          const auto other = ggx(cosine, alpha * (1 + across));
          const auto both = ggx(cosine * (1 + along), alpha * (1 + across));
          loss = std::max(loss, std::abs(both.loss - one.loss - other.loss + here.loss) / here.loss);
          bias = std::max(bias, std::abs(both.bias - one.bias - other.bias + here.bias));
        }
      }
    }
  }
  EXPECT_LT(loss, GgxRange<Bound>::loss_changes_together * share * share);
  EXPECT_GT(loss, 0.2 * GgxRange<Bound>::loss_changes_together * share * share) << "and the figure is not beside the matter";
  EXPECT_LT(bias, GgxRange<Bound>::bias_changes_together * share * share);
  EXPECT_GT(bias, 0.2 * GgxRange<Bound>::bias_changes_together * share * share);
}

}  // namespace
}  // namespace sheen::golden
