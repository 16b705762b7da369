#include "renderer/target.h"

#include <algorithm>
#include <array>
#include <string>

namespace sheen::renderer {
namespace {

void check_size(const gles::Context& context, int width, int height) {
  const gles::Functions& gl = context.gl();
  GLint largest = 0;
  std::array<GLint, 2> viewport{0, 0};
  gl.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
  gl.GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
  const int most = std::min({largest, viewport[0], viewport[1]});
  if (width < 1 || height < 1 || width > most || height > most) {
    throw gles::Error(context.info().renderer + " draws pictures from 1 x 1 to " + std::to_string(most) + " x " + std::to_string(most) +
                      ", not " + std::to_string(width) + " x " + std::to_string(height));
  }
}

}  // namespace

Target::Target(const gles::Context& context, int width, int height)
    : gl_(&context.gl()), width_(width), height_(height), color_(*gl_), depth_(*gl_), framebuffer_(*gl_) {
  const gles::Functions& gl = *gl_;
  check_size(context, width, height);
  if (!context.info().desktop && gl.EXT_color_buffer_float == 0) {
    throw gles::Error(context.info().renderer + " lacks GL_EXT_color_buffer_float: it cannot draw into 32-bit floats");
  }
  gl.BindRenderbuffer(GL_RENDERBUFFER, color_.name());
  gl.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA32F, width, height);
  gl.BindRenderbuffer(GL_RENDERBUFFER, depth_.name());
  gl.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width, height);
  gles::check(gl, "making a target of " + std::to_string(width) + " x " + std::to_string(height));
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color_.name());
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_.name());
  gles::check_framebuffer(gl, "RGBA32F target");
}

void Target::begin() const {
  const gles::Functions& gl = *gl_;
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  gl.Viewport(0, 0, width_, height_);
  gl.DepthMask(GL_TRUE);
  gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl.Disable(GL_SCISSOR_TEST);
  const std::array<float, 4> transparent{0.0f, 0.0f, 0.0f, 0.0f};
  const float farthest = 1.0f;
  gl.ClearBufferfv(GL_COLOR, 0, transparent.data());
  gl.ClearBufferfv(GL_DEPTH, 0, &farthest);
}

image::Image Target::read() const {
  const gles::Functions& gl = *gl_;
  image::Image picture(width_, height_, {"R", "G", "B", "A"});
  gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  gl.PixelStorei(GL_PACK_ALIGNMENT, 4);
  gl.ReadPixels(0, 0, width_, height_, GL_RGBA, GL_FLOAT, picture.data.data());
  gles::check(gl, "reading the picture back");
  // GL's first row is the lowest.
  const auto row = static_cast<std::ptrdiff_t>(width_) * 4;
  for (int y = 0; y < height_ / 2; ++y) {
    const auto upper = picture.data.begin() + row * y;
    std::swap_ranges(upper, upper + row, picture.data.begin() + row * (height_ - 1 - y));
  }
  return picture;
}

}  // namespace sheen::renderer
