#pragma once

#include <cstdint>
#include <functional>

#include "image/image.h"

namespace sheen::conformance {

/// What our own viewer draws under an environment where it is not told otherwise, directions a pixel.
inline constexpr int environment_directions = 4096;
/// So many pictures, each of its own share of the directions and independent of the others, tell what directions leave by chance.
inline constexpr int environment_replicas = 16;
/// Of the standard error that 16 replicas show, as many as hold their mean as surely as five of a known one hold a normal deviate, which
/// passes them once in 1.7 million: Student's distribution of 15 degrees of freedom.
inline constexpr double replica_standard_errors = 8.268;

/// What chance may be granted of a value that independent directions bring, none more than `largest`: what replicas show, but at most what
/// a sum of such has for its value, and what may have been missed by all. With p the probability that five standard errors are passed: a
/// sum of variance at most largest * value is off by sqrt(2 ln(2 / p) largest * value) (Bernstein 1946, for the most of it), and directions
/// of which ln(1 / p) are expected all miss once in 1 / p.
/// @param shown  by replicas, standard errors and their number
double granted_to_chance(double shown, double value, double largest);

/// Directions a pixel of each replica, of as many in all.
int directions_of_replica(int directions);

/// Draws replicas: R G B A, their mean, and "replica.1.R", "replica.1.G", "replica.1.B", "replica.2.R" ...
/// @param draw  a picture R G B A of the directions of a seed
/// @param seed  of all; each replica has one of its own, never 0
image::Image draw_replicas(const std::function<image::Image(std::uint64_t seed)>& draw, int replicas, std::uint64_t seed);

/// R G B A of a picture that holds replicas, with the standard errors of their mean as standard_error.R .G .B; any other as it is. What is
/// not finite in one replica is not finite in the mean.
image::Image with_standard_errors(const image::Image& picture);

}  // namespace sheen::conformance
