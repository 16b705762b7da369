#pragma once

#include <span>
#include <string>

#include "gles/objects.h"
#include "scene/scene.h"
#include "scene/texels.h"

namespace sheen::renderer {

/// How level 0 of a picture stands in its texture, as shaders/textures.glsl counts. Codes of 8 bits take a quarter of the room of floats
/// and are decoded where they are read; the levels below them are means in linear light, which are no codes.
enum class Storage { Floats, LinearCodes, SrgbCodes };

/// Codes where the picture has 8 bits.
Storage storage_of(const scene::Picture& picture, scene::ColorSpace space);

/// An RGBA32UI texture of one level in which shaders/textures.glsl finds a picture with its mipmaps. Filled part by part; from when it is
/// made until take(), it must stay the bound texture.
class PictureTexture {
 public:
  /// Room for a picture of that size. Throws gles::Error, naming `what`, where the driver takes none so large.
  PictureTexture(const gles::Functions& gl, std::string what, int width, int height, Storage storage, bool mipmapped);

  /// Level 0 out of the picture's codes.
  void put_level0(const scene::Picture& picture, scene::ColorSpace space) const;
  /// A level as floats: any but a level 0 that is stored as codes. After the last level of a picture comes a copy of it.
  void put_level(int level, const scene::Texels& texels) const;

  /// Throws gles::Error where anything went wrong.
  gles::Texture take();

 private:
  struct Place {
    int x, y;
  };
  Place origin(int level) const;
  template <class Value, class Fill>
  void put_lines(int columns, int lines, const Fill& fill) const;

  const gles::Functions* gl_;
  std::string what_;
  int width_, height_;
  Storage storage_;
  gles::Texture texture_;
};

/// The levels of a picture from 1 on, as PictureTexture takes them: the last one twice.
std::vector<scene::Texels> levels_below(const scene::Picture& picture, scene::ColorSpace space);

/// An image of floats with its mipmaps, from level 0 on, which `levels` holds.
gles::Texture upload_mipmapped(const gles::Functions& gl, const std::string& what, const std::vector<scene::Texels>& levels);

}  // namespace sheen::renderer
