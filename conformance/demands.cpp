#include "conformance/demands.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace sheen::conformance {
namespace {

/// +1 for one picture, -1 for another.
Demand difference(Must must, std::size_t count, std::size_t plus, std::size_t minus) {
  Demand demand{must, std::vector<double>(count, 0.0)};
  demand.weights[plus] = 1;
  demand.weights[minus] = -1;
  return demand;
}

void demand_order(std::vector<Demand>& demands, std::size_t count, std::size_t brighter, std::size_t darker) {
  demands.push_back(difference(Must::NotBePositive, count, darker, brighter));
  demands.push_back(difference(Must::BePositive, count, brighter, darker));
}

/// What a tone mapping leaves of a linear law: where w_0 L_0 = sum of |w_i| L_i and |w_i| >= w_0, no L_i >= 0 is above L_0.
bool leaves_order(const Relation& relation) {
  return relation.weights.front() > 0 && std::all_of(relation.weights.begin() + 1, relation.weights.end(),
                                                     [&relation](double weight) { return weight <= -relation.weights.front(); });
}

}  // namespace

double Demand::counted(double sum) const {
  return must == Must::Vanish || must == Must::Differ ? std::abs(sum) : std::max(sum, 0.0);
}

std::vector<Demand> demands_of(const Relation& relation, bool tone_mapped) {
  const std::size_t count = relation.scenes.size();
  std::vector<Demand> demands;
  if (relation.kind == RelationKind::Linear && !tone_mapped) {
    demands.push_back({Must::Vanish, relation.weights});
    return demands;
  }
  for (std::size_t i = 1; i < count; ++i) {
    switch (relation.kind) {
      case RelationKind::Equal:
        demands.push_back(difference(Must::Vanish, count, 0, i));
        break;
      case RelationKind::Differs:
        demands.push_back(difference(Must::Differ, count, 0, i));
        break;
      case RelationKind::Brighter:
        demand_order(demands, count, i - 1, i);
        break;
      case RelationKind::Linear:
        if (leaves_order(relation)) {
          demand_order(demands, count, 0, i);
        }
        break;
    }
  }
  return demands;
}

}  // namespace sheen::conformance
