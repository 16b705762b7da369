#pragma once

#include <array>
#include <cstddef>

#include "albedo/ggx_interpolant.h"

namespace sheen::albedo {

/// GgxInterpolant at cosines and alphas of which each comes again, with others of the other kind, mostly in the same order: the same values
/// at a fraction of the price. The interpolant must outlive it.
class GgxPlaces {
 public:
  explicit GgxPlaces(const GgxInterpolant& interpolant) : interpolant_(interpolant) {}

  GgxAlbedo operator()(double n_dot_v, double alpha) {
    return interpolant_(cosines_.at(n_dot_v, GgxInterpolant::cosine), alphas_.at(alpha, GgxInterpolant::alpha));
  }

 private:
  /// The last few of those asked for.
  template <class Place>
  class Kept {
   public:
    /// @param make  a Place of a value
    template <class Make>
    Place& at(double value, const Make& make) {
      // After the one asked for last.
      for (std::size_t i = 0; i < count_; ++i) {
        const std::size_t there = last_ + 1 + i < count_ ? last_ + 1 + i : last_ + 1 + i - count_;
        if (values_[there] == value) {
          last_ = there;
          return places_[there];
        }
      }
      const std::size_t there = count_ < most ? count_++ : next_++ % most;
      values_[there] = value;
      last_ = there;
      return places_[there] = make(value);
    }

   private:
    static constexpr std::size_t most = 48;
    std::array<double, most> values_;
    std::array<Place, most> places_;
    std::size_t count_ = 0, last_ = 0, next_ = 0;
  };

  const GgxInterpolant& interpolant_;
  Kept<GgxCosine> cosines_;
  Kept<GgxAlpha> alphas_;
};

}  // namespace sheen::albedo
