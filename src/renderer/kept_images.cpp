#include "renderer/kept_images.h"

#include <system_error>

#include "image/io.h"

namespace sheen::renderer {
namespace {

// Counts on when what lies in the folder is made in another way.
constexpr const char* version = "1";

}  // namespace

image::Image KeptImages::get(const std::string& name, int width, int height, const std::function<image::Image()>& make) const {
  const std::filesystem::path file = folder_ / (name + "." + version + ".pfm");
  std::error_code error;
  if (!folder_.empty() && std::filesystem::is_regular_file(file, error)) {
    try {
      image::Image found = image::read(file);
      if (found.width == width && found.height == height) {
        return found;
      }
    } catch (const image::Error&) {
      // Damaged: made anew.
    }
  }
  image::Image made = make();
  if (!folder_.empty()) {
    std::filesystem::create_directories(folder_, error);
    try {
      image::write(file, made);
    } catch (const image::Error&) {
      // A folder that cannot be written costs the next program the time, nothing else.
    }
  }
  return made;
}

}  // namespace sheen::renderer
