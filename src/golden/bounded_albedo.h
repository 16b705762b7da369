#pragma once

#include "golden/albedo_reader.h"
#include "golden/ggx_range.h"
#include "golden/shade.h"
#include "golden/sheen_range.h"
#include "number/bounded_conversion.h"

namespace sheen::golden {

/// Tabulated albedos on number::Bounded.
template <class Precision>
struct AlbedoReader<number::Bounded<Precision>> {
  using B = number::Bounded<Precision>;

  /// At one roughness, see SheenRange.
  class Sheen {
   public:
    Sheen(const SheenAlbedo& albedo, const B& roughness) : albedo_(albedo), roughness_(roughness) {
      SheenRange<B>::find(roughness, roughnesses_);
    }
    B operator()(const B& cosine) const { return SheenRange<B>::at(albedo_, roughnesses_, cosine, roughness_); }

   private:
    SheenAlbedo albedo_;
    B roughness_;
    SheenRoughnesses roughnesses_;
  };

  template <class Read>
  static B for_light(const B& e_v, const B& n_dot_l, const B& n_dot_v, const Read& read) {
    const bool smaller = n_dot_v.is_bounded() && n_dot_l.is_bounded() && n_dot_v.range().lower >= albedo::decreasing_from &&
                         n_dot_l.range().lower >= n_dot_v.range().upper;
    return smaller ? e_v : read();
  }

  /// At one alpha, see GgxRange.
  class Ggx {
   public:
    Ggx(const BaseAlbedo& albedo, const B& alpha) : albedo_(albedo), alpha_(alpha) { GgxRange<B>::find(alpha, alphas_); }
    brdf::LobeAlbedo<B> operator()(const B& cosine) const { return GgxRange<B>::at(albedo_, alphas_, cosine, alpha_); }
    brdf::LobeAlbedo<B> average() const { return GgxRange<B>::average(albedo_, alphas_, alpha_); }

   private:
    BaseAlbedo albedo_;
    B alpha_;
    GgxAlphas alphas_;
  };
};

/// The golden's own shading tells it.
template <class Precision>
inline constexpr bool finds_lookup_error<number::Bounded<Precision>> = false;

}  // namespace sheen::golden
