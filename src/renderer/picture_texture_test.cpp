#include "renderer/picture_texture.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "gles/context.h"
#include "renderer/program.h"
#include "renderer/shader_sources.h"
#include "renderer/target.h"
#include "renderer/test_scene.h"

namespace sheen::renderer {
namespace {

using scene::ColorSpace;
using scene::Filter;
using scene::MipFilter;
using scene::Wrap;

constexpr scene::Sampler nearest{Wrap::ClampToEdge, Wrap::ClampToEdge, Filter::Nearest, Filter::Nearest, MipFilter::None};
constexpr scene::Sampler nearest_of_levels{Wrap::ClampToEdge, Wrap::ClampToEdge, Filter::Nearest, Filter::Nearest, MipFilter::Nearest};

/// A picture of so many bits whose neighbours differ, in every channel.
scene::Picture motley(int width, int height, int bits) {
  std::vector<std::uint16_t> codes;
  for (int i = 0; i < width * height * 4; ++i) {
    codes.push_back(static_cast<std::uint16_t>((i * 40503 + i / 7) % (1 << bits)));
  }
  scene::Picture picture = test::picture(width, height, codes);
  picture.bits = bits;
  return picture;
}

/// How far a shader's value may lie from the decoded one, in units of its last digit, of which a sum or a product takes 1 (GLSL ES
/// 3.00.6, section 4.5.1), its rounding mode being open. A code's 255th is rounded once. sRGB's x = (code + 0.055) / 1.055 adds
/// a sum and a product with a constant that is half a unit off, and x^2.4 magnifies that 2.4 times. Its x^0.4 misses 0.4 ln 2 times the 6
/// units of log2 (3 of a value up to 3.5), ln 2 of its exponent's product, and the 3 + 2 * 1.4 of exp2; then there are two products.
double allowed(ColorSpace space, double value) {
  constexpr double unit = 0x1p-23;
  return value * unit * (space == ColorSpace::Linear ? 1.0 : 2.4 * 3.5 + 0.28 * 6.0 + 0.7 + 5.8 + 2.0);
}

class PictureTexturing : public testing::Test {
 protected:
  /// Reads a picture over (u, v) from `from` to `to`, at the centres of columns x rows pixels.
  image::Image read(const scene::Picture& picture, ColorSpace space, const scene::Sampler& sampler, int columns, int rows,
                    glm::dvec2 from = {0, 0}, glm::dvec2 to = {1, 1}) {
    const gles::Functions& gl = context_->gl();
    const bool mipmapped = sampler.mip != MipFilter::None;
    const Storage storage = storage_of(picture, space);
    PictureTexture filled(gl, "a picture", picture.width, picture.height, storage, mipmapped);
    filled.put_level0(picture, space);
    int level = 1;
    for (const scene::Texels& texels : mipmapped ? levels_below(picture, space) : std::vector<scene::Texels>()) {
      filled.put_level(level++, texels);
    }
    const gles::Texture texture = filled.take();
    std::string state = "u_size";
    for (const int value : {static_cast<int>(sampler.wrap_s), static_cast<int>(sampler.wrap_t), static_cast<int>(sampler.mag),
                            static_cast<int>(sampler.min), static_cast<int>(sampler.mip), static_cast<int>(storage)}) {
      state += ", " + std::to_string(value);
    }
    const std::string head = "#version 300 es\nprecision highp float;\nprecision highp int;\n";
    const Program program(gl, {head + shader_sources().at("fullscreen.vert"), head + "precision highp sampler2D;\n" +
                                                                                  shader_sources().at("textures.glsl") + R"(
      uniform usampler2D u_picture;
      uniform ivec2 u_size;
      uniform vec2 u_from;
      uniform vec2 u_step;
      uniform float u_rows;
      layout(location = 0) out vec4 out_color;
      void main() {
        vec2 pixel = vec2(gl_FragCoord.x, u_rows - gl_FragCoord.y);
        out_color = texture_sample(u_picture, u_from + pixel * u_step, )" + state +
                                                                                  ");\n}\n"});
    const Target target(*context_, columns, rows);
    target.begin();
    gl.Viewport(0, 0, columns, rows);
    program.use();
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindTexture(GL_TEXTURE_2D, texture.name());
    program.set("u_picture", 0);
    program.set("u_size", glm::ivec2(picture.width, picture.height));
    program.set("u_from", from);
    program.set("u_step", (to - from) / glm::dvec2(columns, rows));
    program.set("u_rows", static_cast<double>(rows));
    const gles::VertexArray nothing(gl);
    gl.BindVertexArray(nothing.name());
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    return target.read();
  }

  static void expect_texel(const image::Image& drawn, int x, int y, const glm::vec4& texel, ColorSpace space, const std::string& what) {
    for (int c = 0; c < 4; ++c) {
      const auto expected = static_cast<double>(texel[c]);
      ASSERT_NEAR(drawn.at(x, y, c), expected, allowed(c == 3 ? ColorSpace::Linear : space, expected))
          << what << ": pixel " << x << ", " << y << ", channel " << c;
    }
  }

 private:
  std::unique_ptr<gles::Context> context_ = gles::Context::create_any(gles::ContextKind::OsMesa);
  gles::CurrentScope current_{*context_};
};

const glm::vec4& texel(const scene::Texels& texels, int x, int y) {
  return texels.rgba[static_cast<std::size_t>(y) * static_cast<std::size_t>(texels.width) + static_cast<std::size_t>(x)];
}

TEST(Storage, IsOfCodesWhereTheyHaveEightBits) {
  EXPECT_EQ(storage_of(motley(1, 1, 8), ColorSpace::Linear), Storage::LinearCodes);
  EXPECT_EQ(storage_of(motley(1, 1, 8), ColorSpace::Srgb), Storage::SrgbCodes);
  EXPECT_EQ(storage_of(motley(1, 1, 16), ColorSpace::Linear), Storage::Floats);
  EXPECT_EQ(storage_of(motley(1, 1, 16), ColorSpace::Srgb), Storage::Floats);
}

TEST_F(PictureTexturing, EveryCodeOfEightBitsIsReadAsItIsDecoded) {
  std::vector<std::uint16_t> codes;
  for (int code = 0; code < 256; ++code) {
    for (int c = 0; c < 4; ++c) {
      codes.push_back(static_cast<std::uint16_t>((code + 64 * c) % 256));
    }
  }
  const scene::Picture picture = test::picture(16, 16, codes);
  for (const ColorSpace space : {ColorSpace::Linear, ColorSpace::Srgb}) {
    const scene::Texels texels = scene::decode(picture, space);
    const image::Image drawn = read(picture, space, nearest, 16, 16);
    for (int i = 0; i < 256; ++i) {
      expect_texel(drawn, i % 16, i / 16, texel(texels, i % 16, i / 16), space, space == ColorSpace::Srgb ? "sRGB" : "linear");
    }
  }
}

// As many pixels as a level has texels read that level: for these sizes, odd ones too, lambda lies within half a level of it.
TEST_F(PictureTexturing, EveryTexelOfEveryLevelIsReadWhereItStands) {
  for (const auto& [width, height] : {std::pair{1, 1}, std::pair{2, 1}, std::pair{3, 2}, std::pair{5, 7}, std::pair{13, 1}, std::pair{1, 9},
                                      std::pair{16, 4}, std::pair{33, 9}}) {
    for (const int bits : {8, 16}) {
      for (const ColorSpace space : {ColorSpace::Linear, ColorSpace::Srgb}) {
        const scene::Picture picture = motley(width, height, bits);
        const std::vector<scene::Texels> levels = scene::mipmaps(scene::decode(picture, space));
        for (std::size_t level = 0; level < levels.size(); ++level) {
          const scene::Texels& texels = levels[level];
          const image::Image drawn = read(picture, space, nearest_of_levels, texels.width, texels.height);
          for (int y = 0; y < texels.height; ++y) {
            for (int x = 0; x < texels.width; ++x) {
              expect_texel(drawn, x, y, texel(texels, x, y), level == 0 && bits == 8 ? space : ColorSpace::Linear,
                           std::to_string(width) + " x " + std::to_string(height) + ", " + std::to_string(bits) + " bits, level " +
                               std::to_string(level));
            }
          }
        }
      }
    }
  }
}

TEST_F(PictureTexturing, CodesWrapOnEverySideOfAnOddPicture) {
  const scene::Picture picture = motley(5, 3, 8);
  const scene::Texels texels = scene::decode(picture, ColorSpace::Srgb);
  const auto wrapped = [](int i, int size, Wrap wrap) {
    const int period = wrap == Wrap::MirroredRepeat ? 2 * size : size;
    const int rest = ((i % period) + period) % period;
    return wrap == Wrap::ClampToEdge ? std::clamp(i, 0, size - 1) : rest < size ? rest : period - 1 - rest;
  };
  for (const Wrap wrap : {Wrap::Repeat, Wrap::MirroredRepeat, Wrap::ClampToEdge}) {
    scene::Sampler sampler = nearest;
    sampler.wrap_s = sampler.wrap_t = wrap;
    const image::Image drawn = read(picture, ColorSpace::Srgb, sampler, 25, 15, {-2, -2}, {3, 3});
    for (int y = 0; y < 15; ++y) {
      for (int x = 0; x < 25; ++x) {
        expect_texel(drawn, x, y, texel(texels, wrapped(x - 10, 5, wrap), wrapped(y - 6, 3, wrap)), ColorSpace::Srgb,
                     "wrap " + std::to_string(static_cast<int>(wrap)));
      }
    }
  }
}

// At the corners between texels each of four counts a quarter; decoded first, for the mean of codes is no mean of light.
TEST_F(PictureTexturing, BilinearFilteringMixesDecodedCodes) {
  const scene::Picture picture = motley(6, 5, 8);
  scene::Sampler linear = nearest;
  linear.mag = linear.min = Filter::Linear;
  linear.wrap_s = linear.wrap_t = Wrap::Repeat;
  for (const ColorSpace space : {ColorSpace::Linear, ColorSpace::Srgb}) {
    const scene::Texels texels = scene::decode(picture, space);
    // Pixel centres lie half a texel off the texels' own.
    const image::Image drawn =
        read(picture, space, linear, 6, 5, glm::dvec2(0.5) / glm::dvec2(6, 5), glm::dvec2(1.0) + glm::dvec2(0.5) / glm::dvec2(6, 5));
    for (int y = 0; y < 5; ++y) {
      for (int x = 0; x < 6; ++x) {
        const glm::vec4 mean = 0.25F * (texel(texels, x, y) + texel(texels, (x + 1) % 6, y) + texel(texels, x, (y + 1) % 5) +
                                        texel(texels, (x + 1) % 6, (y + 1) % 5));
        for (int c = 0; c < 4; ++c) {
          // The weights are a quarter to within the rounding of a coordinate of up to 6 texels.
          EXPECT_NEAR(drawn.at(x, y, c), mean[c], 1e-5) << x << ", " << y << ", channel " << c;
        }
      }
    }
  }
}

}  // namespace
}  // namespace sheen::renderer
