#pragma once

namespace sheen::number {

/// What a comparison of uncertain values says: what it is for their centres, and whether every conforming implementation agrees.
class Truth {
 public:
  constexpr Truth(bool at_center, bool certain) : at_center_(at_center), certain_(certain) {}

  constexpr bool is_true() const { return certain_ && at_center_; }
  constexpr bool is_false() const { return certain_ && !at_center_; }
  constexpr bool is_either() const { return !certain_; }
  constexpr bool at_center() const { return at_center_; }

 private:
  bool at_center_, certain_;
};

/// Whether it may hold.
constexpr bool any(Truth t) {
  return !t.is_false();
}

/// select() of what two functions give; where the choice is certain, one of them is called.
template <class A, class B>
auto select_of(Truth condition, const A& a, const B& b) {
  return condition.is_either() ? select(condition, a(), b()) : condition.is_true() ? a() : b();
}

}  // namespace sheen::number
