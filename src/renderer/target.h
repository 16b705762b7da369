#pragma once

#include "gles/objects.h"
#include "image/image.h"

namespace sheen::renderer {

/// An RGBA32F picture with a 32-bit float depth buffer to draw into.
class Target {
 public:
  /// Throws gles::Error when the context cannot draw into 32-bit floats or not at this size.
  Target(const gles::Context& context, int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Binds it and clears it to transparent black.
  void begin() const;
  /// What was drawn: channels R G B A, rows from the top.
  image::Image read() const;

 private:
  const gles::Functions* gl_;
  int width_;
  int height_;
  gles::Renderbuffer color_;
  gles::Renderbuffer depth_;
  gles::Framebuffer framebuffer_;
};

}  // namespace sheen::renderer
