#include "renderer/kept_table.h"

#include <algorithm>
#include <cstddef>
#include <string>

#include "renderer/feature_words.h"

namespace sheen::renderer {
namespace {

image::Image image_of(const albedo::Table& table) {
  image::Image image(albedo::Table::width, albedo::Table::height, {"R", "G", "B"});
  auto out = image.data.begin();
  for (const float value : table.values) {
    out = std::fill_n(out, 3, value);
  }
  return image;
}

}  // namespace

albedo::Table kept_table(const KeptImages& kept, albedo::Visibility visibility) {
  const image::Image image = kept.get(std::string("sheen-albedo-") + visibility_name(visibility), albedo::Table::width,
                                      albedo::Table::height, [&] { return image_of(albedo::build_table(visibility)); });
  albedo::Table table;
  table.visibility = visibility;
  for (std::size_t i = 0; i < image.data.size(); i += 3) {
    table.values.push_back(image.data[i]);
  }
  return table;
}

}  // namespace sheen::renderer
