#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "albedo/interpolant.h"
#include "albedo/table_reading.h"

namespace sheen::albedo {

/// A table whose reading is sought: values[row * width + column], rows from the top; some may not be finite.
struct TablePlane {
  int width = 0;
  int height = 0;
  std::vector<double> values;

  double at(int column, int row) const {
    return values[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column)];
  }
};

/// E of each visibility, quickly; safe from many threads.
class AlbedoSource {
 public:
  double operator()(Visibility visibility, const TablePoint& point) const {
    return sources_[static_cast<std::size_t>(visibility)](point.n_dot_v, point.sheen_roughness);
  }

 private:
  std::array<Interpolant, 3> sources_{Interpolant(Visibility::Charlie), Interpolant(Visibility::Ashikhmin),
                                      Interpolant(Visibility::Refined)};
};

/// x / (1 + x), in which readings are compared: an absolute error where E is small, a relative one where it is large, and no value
/// outweighs the others. Negative values stay, down to -1.
double compressed(double value);

/// Some texels of a table, the same for every reading that is compared.
struct TableSample {
  struct Texel {
    int column, row;
    double value;  ///< compressed
  };
  std::vector<Texel> texels;
  double variance = 0;  ///< of the values
};

/// At most per_side x per_side finite texels, evenly spread over the table without its outer twelfth: there tables differ in how they
/// treat their ends, and E is costly and known to few digits.
TableSample sample_of(const TablePlane& plane, int per_side);

/// A reading and how far it is off: the mean square difference of compressed values over a sample.
struct ScoredReading {
  TableReading reading;
  double loss;
};

/// The reading, clamped or not, whichever fits the sample better.
ScoredReading scored(const TableReading& reading, const TablePlane& plane, const TableSample& sample, const AlbedoSource& source);

/// Texels a side of the sample that the search ends with.
inline constexpr int search_side = 48;

/// Readings that fit best, best first, each differing from all others in something but `clamped`: coarse to fine over visibility, form,
/// axis, orientation, shifts of up to 8 rows (an eighth of a small table) in half texels, columns within half a texel, and texels.
/// Their losses are over sample_of(plane, search_side). Empty where nothing comes near.
std::vector<ScoredReading> search(const TablePlane& plane, const AlbedoSource& source);

/// How surely a fits better than b: the mean of their squared errors' difference over its standard error. Positive where a is better.
double significance(const TableReading& a, const TableReading& b, const TablePlane& plane, const TableSample& sample,
                    const AlbedoSource& source);

}  // namespace sheen::albedo
