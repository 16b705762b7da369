#pragma once

#include <cmath>
#include <cstddef>

#include "albedo/sheen_model.h"

namespace sheen::albedo {

/// Where a function of the cosine turns from rising to falling or back, and what it may be there.
struct Turn {
  double from, to;  ///< n_dot_v, between which it lies
  double lowest, highest;
};

/// Few of them; plain numbers, so that a batched translation unit instantiates no container.
struct Turns {
  static constexpr std::size_t most = 6;
  Turn turn[most];
  std::size_t count = 0;

  /// More than there is room for are told as one.
  void add(const Turn& t) {
    if (count < most) {
      turn[count++] = t;
      return;
    }
    Turn& last = turn[most - 1];
    last.to = t.to;
    last.lowest = t.lowest < last.lowest ? t.lowest : last.lowest;
    last.highest = t.highest > last.highest ? t.highest : last.highest;
  }
};

/// Of a function that is smooth over a thirtieth of ln n_dot_v: looked for at places that lie so far apart. Between three of them it goes
/// no farther than twice as far as a parabola does.
/// @param f           of n_dot_v in [min_n_dot_v, 1]
/// @param negligible  turns that change it by less are none
template <class Function>
Turns turns_of(const Function& f, double negligible) {
  constexpr int places = 300;
  const auto place = [](int i) { return std::exp(std::log(min_n_dot_v) * (1 - static_cast<double>(i) / places)); };
  Turns turns;
  double before = f(place(0));
  double here = f(place(1));
  for (int i = 2; i <= places; ++i) {
    const double after = f(place(i));
    const double bend = before + after - 2 * here;
    if ((here - before) * (after - here) <= 0 && std::abs(bend) > negligible) {
      turns.add({place(i - 2), place(i), here - 0.25 * std::abs(bend), here + 0.25 * std::abs(bend)});
    }
    before = here;
    here = after;
  }
  return turns;
}

}  // namespace sheen::albedo
