#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "albedo/sheen_model.h"
#include "golden/albedo_reader.h"
#include "number/bounded.h"

namespace sheen::golden {

/// One of a range's places.
enum class End { Lower, Center, Upper };

/// Whether the ends of a roughness or an alpha differ by more than hundredths.
template <class B>
bool is_wide_roughness(const B& roughness) {
  return roughness.range().upper > 1.05 * roughness.range().lower;
}

/// Places of the same ratio each.
template <std::size_t most>
struct Steps {
  std::array<double, most + 1> place;
  std::size_t count;  ///< of steps, at least 2: of places one more

  /// @param per_e  in a ratio of e, while they are not too many
  Steps(double lower, double highest, double per_e) {
    const double upper = std::max(highest, lower);
    const double logarithm = std::isfinite(upper) ? std::log(upper / lower) : 0;
    count = std::min(2 + static_cast<std::size_t>(per_e * logarithm), most);
    const double ratio = std::exp(logarithm / static_cast<double>(count));
    place[0] = lower;
    for (std::size_t i = 1; i < count; ++i) {
      place[i] = place[i - 1] * ratio;
    }
    place[count] = upper;
  }

  /// What f reaches between the places: what it has there, and beyond that twice as far as a parabola through three neighbours goes.
  template <class Function, class Include>
  void include_between(const Function& f, const Include& include) const {
    double first = f(place[0]);
    double middle = f(place[1]);
    for (std::size_t i = 2; i <= count; ++i) {
      const double last = f(place[i]);
      const double bend = 0.25 * std::abs(first + last - 2.0 * middle);
      include(std::max(first, std::max(middle, last)) + bend);
      include(std::max(0.0, std::min(first, std::min(middle, last)) - bend));
      first = middle;
      middle = last;
    }
  }
};

/// The last few places that were asked for: a range's centre, ends and middle.
template <class Place>
class Kept {
 public:
  /// @param make  a Place of a value
  explicit Kept(Place (*make)(double)) : make_(make) {}

  Place& at(double value) {
    for (std::size_t i = 0; i < made_ && i < most; ++i) {
      if (values_[i] == value) {
        return places_[i];
      }
    }
    const std::size_t next = made_++ % most;
    values_[next] = value;
    return places_[next] = make_(value);
  }

 private:
  static constexpr std::size_t most = 4;
  Place (*make_)(double);
  std::array<double, most> values_;
  std::array<Place, most> places_;
  std::size_t made_ = 0;
};

/// A range without a slope. @param off  of what a shader reads
template <class B>
B within(double value, const number::Range& range, double off) {
  const double radius = std::max(range.upper - value, value - range.lower);
  return B::rounded({value, 0, 0, radius, range}, B::Error::absolute(0, off), true);
}

/// The most steps that a range of cosines is gone through in.
inline constexpr std::size_t most_cosine_steps = 40;

/// An albedo at places of a cosine and of a roughness: about each it is beyond what it is there by no more than twice what parabolas
/// through it and two neighbours are.
template <std::size_t most_roughnesses>
class AlbedoGrid {
 public:
  /// @param roughnesses  how many
  explicit AlbedoGrid(std::size_t roughnesses) : columns_(roughnesses) {}

  /// The next cosine's. @param at  the albedo at the roughnesses
  template <class At>
  void add(const At& at) {
    for (std::size_t i = 0; i < columns_; ++i) {
      place_[rows_][i] = at(i);
    }
    ++rows_;
  }

  /// @param value  one of those held
  /// @param relative, absolute  what it may be beyond
  number::Range held(double value, double relative, double absolute) const {
    number::Range range{value, value};
    for (std::size_t r = 0; r < rows_; ++r) {
      for (std::size_t c = 0; c < columns_; ++c) {
        const double bend = bend_at(r, rows_, [&](std::size_t i) { return place_[i][c]; }) +
                            bend_at(c, columns_, [&](std::size_t i) { return place_[r][i]; });
        range.lower = std::min(range.lower, place_[r][c] - bend);
        range.upper = std::max(range.upper, place_[r][c] + bend);
      }
    }
    return {std::max(0.0, range.lower * (1 - relative) - absolute), range.upper * (1 + relative) + absolute};
  }

 private:
  /// About the place at i of so many.
  template <class At>
  static double bend_at(std::size_t i, std::size_t count, const At& at) {
    double most = 0;
    for (std::size_t last = std::max<std::size_t>(i, 2); last <= i + 2 && last < count; ++last) {
      most = std::max(most, 0.25 * std::abs(at(last - 2) + at(last) - 2.0 * at(last - 1)));
    }
    return most;
  }

  std::array<std::array<double, most_roughnesses>, most_cosine_steps + 1> place_;
  std::size_t rows_ = 0, columns_;
};

/// Of a narrower range its ends serve, if something is added for how an albedo bends between.
inline constexpr double narrow_cosines = 0.01;

/// f(cosine) of places that tell of a range. Returns the share by which two differ, if they are all, else 0.
template <class B, class Function>
double for_cosines(const B& cosine, double per_e, const Function& f) {
  const double lower = std::max(cosine.range().lower, albedo::min_n_dot_v);
  const double share = (cosine.range().upper - cosine.range().lower) / lower;
  if (share <= narrow_cosines) {
    f(cosine.range().lower);
    f(cosine.range().upper);
    return share;
  }
  const Steps<most_cosine_steps> steps(lower, cosine.range().upper, per_e);
  for (std::size_t i = 0; i <= steps.count; ++i) {
    f(steps.place[i]);
  }
  return 0;
}

/// How far a parabola through what an albedo is at a range's ends and at its centre, wherever that lies, is beyond them in between, at the
/// most. Of a centre near an end, which does not tell how it bends, half of what lies between the ends.
template <class B>
double bend_across(const B& y, double at_lower, double at_center, double at_upper) {
  const double below = y.center() - y.range().lower;
  const double above = y.range().upper - y.center();
  const double width = below + above;
  if (!(std::min(below, above) >= 0.1 * width && width > 0)) {
    return 0.5 * std::abs(at_upper - at_lower);
  }
  return std::abs((at_upper - at_center) / above - (at_center - at_lower) / below) * width / 8;
}

/// An albedo over ranges of a cosine x and a narrow one of a roughness y: value and slope at the centre, all that the ranges reach, and
/// what a shader that reads a table in highp is off. Over a narrow range of cosines an albedo bends one way at the most, so that what is
/// left of the slope is found at the ends, each with each of the other's and with its centre, and it exceeds what is found there by no more
/// than that; of a wide one, see wide_cosines, no slope is made use of, and where it turns in between is looked for.
/// @param f         of a cosine, at an end of y
/// @param turn      includes what f may be at an end of y where it turns in a wide range of cosines
/// @param may_turn  whether it may do so in a narrow one
/// @param error     of what a shader reads: of f, a cosine and a roughness
/// @param together  what a small change of both arguments brings beyond that of either, for each share of the cosine, where f has a value;
///                  infinite where that is not known
template <class B, class Function, class Turn, class Error, class Together>
B read_albedo(const Function& f, const Turn& turn, bool may_turn, const Error& error, const Together& together, const B& x, const B& y) {
  if (!x.is_bounded() || !y.is_bounded()) {
    return B::unbounded(0.0);  // their centres need not be numbers
  }
  const double value = f(x.center(), End::Center);
  const double width = x.range().upper - x.range().lower;
  // It bends where cosines are cut off, as they do in a wide range.
  const bool wide = width > wide_cosines * x.center() || (x.range().lower < albedo::min_n_dot_v && x.range().upper > albedo::min_n_dot_v);
  // A centre near an end does not tell how the albedo bends, the middle does.
  const bool lopsided = x.center() - x.range().lower < 0.25 * width || x.range().upper - x.center() < 0.25 * width;
  const double middle = 0.5 * (x.range().lower + x.range().upper);
  double lowest = value;
  double highest = value;
  double slope = 0;
  double remainder = 0;
  const auto reach = [&](double there) {
    lowest = std::min(lowest, there);
    highest = std::max(highest, there);
  };
  const auto include = [&](double cosine, double there) {
    reach(there);
    remainder = std::max(remainder, std::abs(there - value - slope * (cosine - x.center())));
  };
  double low = value;
  double high = value;
  const double share_x = width / std::max(x.range().lower, albedo::min_n_dot_v);
  const double both = wide || lopsided ? std::numeric_limits<double>::infinity() : together(value) * share_x;
  // Returns f at the centre of x.
  const auto include_ends = [&](End end) {
    const double there = f(x.center(), end);
    include(x.center(), there);
    if (std::isfinite(both)) {
      for (const double sign : {-1.0, 1.0}) {
        include(x.range().lower, low + (there - value) + sign * both);
        include(x.range().upper, high + (there - value) + sign * both);
      }
      return there;
    }
    include(x.range().lower, f(x.range().lower, end));
    if (width > 0) {
      include(x.range().upper, f(x.range().upper, end));
    }
    if (lopsided) {
      include(middle, f(middle, end));
    }
    return there;
  };
  if (width > 0) {
    low = f(x.range().lower, End::Center);
    high = f(x.range().upper, End::Center);
    slope = wide ? 0.0 : (high - low) / width;
    include(x.range().lower, low);
    include(x.range().upper, high);
    if (lopsided) {
      include(middle, f(middle, End::Center));
    }
  }
  const double bend = remainder;
  if (!y.is_exact()) {
    const double at_lower = include_ends(End::Lower);
    const double at_upper = include_ends(End::Upper);
    const double across_bend = bend_across(y, at_lower, value, at_upper);
    highest += across_bend;
    lowest = std::max(0.0, lowest - across_bend);
    remainder += across_bend;
  }
  if (wide) {
    turn(End::Center, reach);
    if (!y.is_exact()) {
      turn(End::Lower, reach);
      turn(End::Upper, reach);
    }
    remainder = std::max(highest - value, value - lowest);
  } else if (may_turn) {
    highest += bend;
    lowest = std::max(0.0, lowest - bend);
  }
  double off = 0;
  if (wide) {
    for (const double c : {x.range().lower, x.center(), x.range().upper}) {
      for (const double r : {y.range().lower, y.center(), y.range().upper}) {
        off = std::max(off, error(highest, c, r));
      }
    }
  } else {
    // It changes by less than four times the share that its arguments do.
    const double shares = width / std::max(x.center(), albedo::min_n_dot_v) +
                          (y.is_exact() ? 0 : (y.range().upper - y.range().lower) / std::max(y.range().lower, 1e-8));
    off = error(highest, x.center(), y.center()) * (1 + 4 * shares);
  }
  return B::rounded({value, slope * x.shift_x(), slope * x.shift_y(), std::abs(slope) * x.radius() + remainder, {lowest, highest}},
                    B::Error::absolute(0, off), true);
}

}  // namespace sheen::golden
