#pragma once

#include <array>
#include <vector>

#include "albedo/split_sum.h"
#include "tools/options.h"
#include "tools/words.h"

namespace sheen::tools {

inline constexpr std::array lut_layout_words{Word<LutLayout>{"plain", LutLayout::Plain}, Word<LutLayout>{"warped", LutLayout::Warped}};
inline constexpr std::array lut_table_words{Word<LutTable>{"sheen", LutTable::Sheen}, Word<LutTable>{"ggx", LutTable::Ggx},
                                            Word<LutTable>{"all", LutTable::All}};

/// A table of E: row-major, rows of rising sheen_roughness, columns of rising cosine; size * size of each.
struct LutGrid {
  std::vector<double> n_dot_v;             ///< (0, 1]
  std::vector<double> sheen_roughness;     ///< (0, 1]
  std::vector<double> directional_albedo;  ///< E, unclamped
};

/// Plain: texel centres, n_dot_v = (column + 1/2) / size and sheen_roughness = (row + 1/2) / size, as a shader's
/// texture(lut, vec2(n_dot_v, sheen_roughness)) reads them.
/// Warped: nodes at the corners, u = column / (size - 1) and r = 0.02 + 0.98 row / (size - 1), of albedo/warped.h.
/// @param size  >= 1, warped >= 2
LutGrid lut_grid(albedo::Visibility visibility, LutLayout layout, int size);

/// What a picture or header holds: E for plain; E * sheen_roughness for warped, which stays near 1 where E grows as 1 / sheen_roughness.
std::vector<double> stored_values(LutLayout layout, const LutGrid& grid);

/// The GGX split sum at the points of a plain table, in its order. @param size  >= 1
std::vector<albedo::SplitSum> split_sum_grid(int size);

/// One line that says how to read a table of this layout.
const char* describe(LutLayout layout);

}  // namespace sheen::tools
