#pragma once

#include <cstddef>

#include "golden/control_variate.h"
#include "golden/direction_pool.h"
#include "golden/lobe_sampling.h"
#include "golden/shade.h"

namespace sheen::golden {

/// What the light of an image at one surface depends on; plain numbers and pointers, for the batched translation unit.
struct ImageSumTask {
  const Surface<double>* surface = nullptr;  ///< without emission
  Layers layers;
  Lighting lighting;  ///< its lights are not used; its curve is needed where there is sheen
  const LobeSampling* sampling = nullptr;
  ImageTexels soft, bright;
  const ControlVariate* control = nullptr;  ///< may be null: then nothing is found of it
};

/// What the points of every strategy add up to.
struct ImageSums {
  brdf::Rgb<double> radiance{0, 0, 0};  ///< toward the camera by way of the surface
  brdf::Rgb<double> control{0, 0, 0};   ///< of the soft part times the control variate, in its place
};

/// Up to a block of points for each strategy.
struct StrategyPoints {
  std::size_t count[strategy_count] = {};
  const LightPoint* light[first_lobe] = {};
  LobePoints lobe[strategy_count] = {};
};

/// Radiance toward the camera by way of the surface, summed over the points of every strategy. With F the integrand under either part of
/// the image, w_k the weight and p_k the density of strategy k, each point adds, by the strategy that drew it,
///
///   soft part, from Soft or a lobe     F / sum of w_k p_k over Soft and the lobes              (balance heuristic, Veach 1997,
///   section 9.2) bright part, from Bright           F w_b p_b / ((w_b p_b)^2 + q^2)                         (power heuristic of exponent
///   2, bright part, from a lobe           F q / ((w_b p_b)^2 + q^2),  q = sum over the lobes      section 9.2.3, the lobes as one)
///
/// so that when strategy k draws n w_k points, the expected sum is n times the integral. Lobes give nothing that lies below both normals'
/// horizons: there a control variate is found by Soft alone.
ImageSums image_sum(const ImageSumTask& task, const StrategyPoints& points);

/// The same, one direction at a time; and in number::Batch, only where number::has_batch().
ImageSums image_sum_scalar(const ImageSumTask& task, const StrategyPoints& points);
ImageSums image_sum_batch(const ImageSumTask& task, const StrategyPoints& points);

/// Directions that light a surface, in arrays, so that a batch of any width finds full lanes.
struct LitDirections {
  static constexpr std::size_t padding = 8;
  static constexpr std::size_t capacity = strategy_count * DirectionPool::block + padding;
  alignas(64) double x[capacity], y[capacity], z[capacity], r[capacity], g[capacity], b[capacity], density[capacity];
  std::size_t count = 0;

  DistantLights lights() const { return {x, y, z, r, g, b}; }

  /// Without a jump whether it is kept, as every other one is not.
  void add(const LightPoint& p, bool kept) {
    x[count] = p.x;
    y[count] = p.y;
    z[count] = p.z;
    r[count] = p.r;
    g[count] = p.g;
    b[count] = p.b;
    density[count] = p.density;
    count += static_cast<std::size_t>(kept);
  }

  /// Fills a last batch with unlit directions.
  void pad(const Vec3<double>& direction, std::size_t lanes) {
    for (std::size_t i = count; i < count + lanes; ++i) {
      x[i] = direction.x;
      y[i] = direction.y;
      z[i] = direction.z;
      r[i] = g[i] = b[i] = density[i] = 0.0;
    }
  }
};

/// image_sum in any number type.
template <class Real>
class ImageSum {
 public:
  explicit ImageSum(const ImageSumTask& task) : task_(task), sampler_(*task.sampling), surface_(spread<Real>(*task.surface)) {}

  ImageSums operator()(const StrategyPoints& points) {
    for (std::size_t k = 0; k < first_lobe; ++k) {
      const bool soft = k == index_of(Strategy::Soft);
      const std::size_t begin = lit_.count;
      keep(points.light[k], points.count[k]);
      lit_.pad(task_.surface->normal, lanes);
      weigh(begin, static_cast<double>(task_.sampling->weights[k]), soft);
      if (soft && task_.control != nullptr) {
        control_below(points.light[k], points.count[k]);
      }
    }
    const std::size_t begin = lit_.count;
    for (std::size_t k = first_lobe; k < strategy_count; ++k) {
      draw(static_cast<Strategy>(k), points.lobe[k], points.count[k]);
    }
    lit_.pad(task_.surface->normal, lanes);
    light_up(begin);
    lit_.pad(task_.surface->normal, lanes);

    const DistantLights lights = lit_.lights();
    Lighting lighting = task_.lighting;
    lighting.distant = &lights;
    lighting.light_count = (lit_.count + lanes - 1) / lanes;
    return {total(shade(surface_, task_.layers, lighting, NoListener{}).radiance), total(control_)};
  }

 private:
  using Lanes = number::Lanes<Real>;
  static constexpr std::size_t lanes = Lanes::count;
  static_assert(lanes <= LitDirections::padding);

  static brdf::Rgb<double> total(const brdf::Rgb<Real>& c) { return {Lanes::sum(c.r), Lanes::sum(c.g), Lanes::sum(c.b)}; }

  // Points of the image that either normal's hemisphere holds.
  void keep(const LightPoint* points, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      lit_.add(points[i], above(points[i]));
    }
  }

  bool above(const LightPoint& p) const {
    const Vec3<double>& n = task_.surface->normal;
    const Vec3<double>& c = task_.layers.clearcoat ? task_.surface->coat_normal : n;
    const bool base = p.x * n.x + p.y * n.y + p.z * n.z > 0.0;
    const bool coat = p.x * c.x + p.y * c.y + p.z * c.z > 0.0;
    return base | coat;
  }

  // The control variate where nothing is lit.
  void control_below(const LightPoint* points, std::size_t count) {
    const std::size_t begin = lit_.count;
    for (std::size_t i = 0; i < count; ++i) {
      lit_.add(points[i], !above(points[i]));
    }
    lit_.pad(task_.surface->normal, lanes);
    using brdf::max;
    const Real weight(static_cast<double>(task_.sampling->weights[index_of(Strategy::Soft)]));
    for (std::size_t i = begin; i < lit_.count; i += lanes) {
      scale(i, Real(1) / max(Lanes::load(lit_.density + i) * weight, Real(1e-300)));
      add_control(i);
    }
    lit_.count = begin;
  }

  void add_control(std::size_t i) { control_ = control_ + (*task_.control)(direction(i)) * arrived(i); }

  Vec3<Real> direction(std::size_t i) const { return {Lanes::load(lit_.x + i), Lanes::load(lit_.y + i), Lanes::load(lit_.z + i)}; }
  brdf::Rgb<Real> arrived(std::size_t i) const { return {Lanes::load(lit_.r + i), Lanes::load(lit_.g + i), Lanes::load(lit_.b + i)}; }

  void store(std::size_t i, const brdf::Rgb<Real>& radiance) {
    Lanes::store(lit_.r + i, radiance.r);
    Lanes::store(lit_.g + i, radiance.g);
    Lanes::store(lit_.b + i, radiance.b);
  }

  void scale(std::size_t i, const Real& by) { store(i, arrived(i) * by); }

  // From the radiance of points drawn from the image to what they add.
  void weigh(std::size_t begin, double weight, bool soft) {
    using brdf::max;
    for (std::size_t i = begin; i < lit_.count; i += lanes) {
      const Real p = Lanes::load(lit_.density + i) * Real(weight);
      const Real q = sampler_.weighted_density(direction(i));
      scale(i, soft ? Real(1) / max(p + q, Real(1e-300)) : p / max(p * p + q * q, Real(1e-300)));
      if (soft && task_.control != nullptr) {
        add_control(i);
      }
    }
  }

  // Directions of a lobe's strategy, those kept that light something.
  void draw(Strategy strategy, const LobePoints& points, std::size_t count) {
    using brdf::max;
    for (std::size_t i = 0; i < count; i += lanes) {
      const Vec3<Real> d = sampler_.draw(strategy, Lanes::load(points.u + i), Lanes::load(points.cosine + i), Lanes::load(points.sine + i));
      const Real cosine = task_.layers.clearcoat ? max(dot(surface_.normal, d), dot(surface_.coat_normal, d)) : dot(surface_.normal, d);
      double each[4][lanes];
      Lanes::store(each[0], d.x);
      Lanes::store(each[1], d.y);
      Lanes::store(each[2], d.z);
      Lanes::store(each[3], cosine);
      for (std::size_t lane = 0; lane < lanes && i + lane < count; ++lane) {
        lit_.x[lit_.count] = each[0][lane];
        lit_.y[lit_.count] = each[1][lane];
        lit_.z[lit_.count] = each[2][lane];
        lit_.count += static_cast<std::size_t>(each[3][lane] > 0.0);
      }
    }
  }

  // What the directions of the lobes see of both parts.
  void light_up(std::size_t begin) {
    using brdf::max;
    const Real soft_weight(static_cast<double>(task_.sampling->weights[index_of(Strategy::Soft)]));
    const Real bright_weight(static_cast<double>(task_.sampling->weights[index_of(Strategy::Bright)]));
    for (std::size_t i = begin; i < lit_.count; i += lanes) {
      const Vec3<Real> d = direction(i);
      const ImagePlace<Real> place(task_.soft, d);
      const Real q = sampler_.weighted_density(d);
      brdf::Rgb<Real> sum{Real(0), Real(0), Real(0)};
      if (lights(task_.soft, place)) {
        const Arrived<Real> soft = look_up(task_.soft, place);
        sum = soft.radiance * (Real(1) / max(soft.density * soft_weight + q, Real(1e-300)));
        if (task_.control != nullptr) {
          store(i, sum);
          lit_.pad(task_.surface->normal, i + lanes > lit_.count ? lanes : 0);
          add_control(i);
        }
      }
      if (lights(task_.bright, place)) {
        const Arrived<Real> bright = look_up(task_.bright, place);
        const Real p = bright.density * bright_weight;
        sum = sum + bright.radiance * (q / max(p * p + q * q, Real(1e-300)));
      }
      store(i, sum);
    }
  }

  const ImageSumTask& task_;
  LobeSampler<Real> sampler_;
  Surface<Real> surface_;
  LitDirections lit_;
  brdf::Rgb<Real> control_{Real(0), Real(0), Real(0)};
};

}  // namespace sheen::golden
