#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "image/image.h"

namespace sheen::renderer {

/// Images that take long to make and are the same every time, kept in a folder so that they outlive the program.
class KeptImages {
 public:
  /// @param folder  empty: nothing is kept. One that cannot be written costs time alone.
  explicit KeptImages(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// The image of that name and size in the folder or, where there is none, what make() gives, which is then put there. Its channels are
  /// R, G, B. May be called from several threads.
  image::Image get(const std::string& name, int width, int height, const std::function<image::Image()>& make) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace sheen::renderer
