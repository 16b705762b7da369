#include "golden/golden.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "golden/frame.h"
#include "golden/tile.h"

namespace sheen::golden {
namespace {

// Pixels a side of a tile: enough surfaces to fill batches, few enough that the last tiles still share out over the threads.
constexpr int tile_size = 16;

// A bound of the float that is stored: by its rounding wider, itself rounded up, and finite. At least the least normal number, below which
// a driver may flush what it draws (GLSL ES 3.00.6, section 4.5.1), and our own processor the value and the bound that are stored.
float stored_bound(double bound, double value) {
  constexpr float largest = std::numeric_limits<float>::max();
  constexpr float least = std::numeric_limits<float>::min();
  const double wide = bound + std::abs(value) * 0x1p-24;
  return wide < static_cast<double>(largest) ? std::max(std::nextafter(static_cast<float>(wide), largest), least) : largest;
}

void store(const Pixel& pixel, bool bounds, int x, int y, image::Image& out) {
  const auto put = [&](int channel, double value) { out.at(x, y, channel) = static_cast<float>(value); };
  for (int c = 0; c < 3; ++c) {
    put(c, pixel.radiance[c]);
  }
  put(3, pixel.coverage);
  if (!bounds) {
    return;
  }
  for (int c = 0; c < 3; ++c) {
    out.at(x, y, 4 + c) = pixel.bound[c] > 0.0 || pixel.radiance[c] != 0.0 ? stored_bound(pixel.bound[c], pixel.radiance[c]) : 0.0F;
  }
  put(7, static_cast<double>(pixel.excluded));
  put(8, pixel.mirrored ? 1.0 : 0.0);
  out.at(x, y, 9) = pixel.coverage_bound > 0.0 ? stored_bound(pixel.coverage_bound, pixel.coverage) : 0.0F;
  const int errors = out.channel("standard_error.R");
  const int directions = out.channel("direction.R");
  for (int c = 0; c < 3; ++c) {
    if (errors >= 0) {
      put(errors + c, pixel.standard_error[c]);
    }
    if (directions >= 0) {
      put(directions + c, pixel.direction[c]);
    }
  }
}

bool bound_of_directions(const Settings& settings) {
  return settings.environment != nullptr && settings.drawn_directions > 0;
}

// Writes the terms down as the shading passes them.
struct TermsListener {
  static constexpr bool wants_e_l = true;
  PixelTerms& terms;

  void view(const ViewPart<double>& part) {
    terms.n_dot_v = part.n_dot_v;
    terms.e_v = part.e_v;
    terms.coat_weight = part.coat_weight;
    terms.emission = dvec3(part.emission);
  }
  void light(std::size_t index, const LightPart<double>& p) {
    terms.lights.push_back({static_cast<int>(index), p.n_dot_l, p.n_dot_h, p.d, p.v, p.e_l, p.scale, p.coat_lobe, dvec3(p.sheen),
                            dvec3(p.base), dvec3(p.coat)});
  }
};

}  // namespace

image::Image render(const scene::Scene& scene, const Settings& settings) {
  const Frame frame(scene, settings);
  std::vector<std::string> channels{"R", "G", "B", "A"};
  if (settings.bounds) {
    channels.insert(channels.end(), {"bound.R", "bound.G", "bound.B", "excluded", "mirrored", "bound.A"});
    if (frame.environment) {
      channels.insert(channels.end(), {"standard_error.R", "standard_error.G", "standard_error.B"});
    }
    if (bound_of_directions(settings)) {
      channels.insert(channels.end(), {"direction.R", "direction.G", "direction.B"});
    }
  }
  image::Image out(settings.view.width, settings.view.height, std::move(channels));
  const int columns = (out.width + tile_size - 1) / tile_size;
  const int rows = (out.height + tile_size - 1) / tile_size;
  std::atomic<int> done{0};
  std::optional<PixelBound> bound;
  if (settings.bounds) {
    bound.emplace(frame);
  }
  tbb::enumerable_thread_specific<Tile> tiles([&] { return Tile(frame, bound ? &*bound : nullptr); });
  const auto draw = [&](const tbb::blocked_range<int>& range) {
    Tile& tile = tiles.local();  // with the memory of its last pixels
    for (int i = range.begin(); i < range.end(); ++i) {
      const int x0 = i % columns * tile_size;
      const int y0 = i / columns * tile_size;
      const int x1 = std::min(x0 + tile_size, out.width);
      const int y1 = std::min(y0 + tile_size, out.height);
      const std::vector<Pixel> pixels = tile.render(x0, y0, x1, y1);
      auto pixel = pixels.begin();
      for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) {
          store(*pixel++, settings.bounds, x, y, out);
        }
      }
      const int finished = ++done;
      if (settings.progress) {
        settings.progress(static_cast<double>(finished) / (static_cast<double>(columns) * rows));
      }
    }
  };
  tbb::parallel_for(tbb::blocked_range<int>(0, columns * rows, 1), draw);
  return out;
}

Probe::Probe(const scene::Scene& scene, const Settings& settings) : frame_(std::make_unique<Frame>(scene, settings)) {}
Probe::~Probe() = default;

PixelTerms Probe::terms(int x, int y, const TermFactors& factors) const {
  const Frame& frame = *frame_;
  const Ray ray = frame.rays.through(x + 0.5, y + 0.5);
  Seen seen;
  frame.tracer.trace(ray, false, seen);
  PixelTerms terms;
  if (seen.empty()) {
    return terms;
  }
  // Whatever is blended lies in front of what is opaque.
  const auto by_depth = [](const Hit& a, const Hit& b) { return a.t < b.t; };
  const Hit hit = seen.blended.empty() ? *seen.nearest : *std::min_element(seen.blended.begin(), seen.blended.end(), by_depth);
  const Placed& placed = frame.geometry.placed(hit.triangle);
  const Surface<double> surface = frame.reader.surface(hit, ray);
  const Layers layers = frame.reader.layers(placed.material_index);
  terms.covered = true;
  terms.material = placed.material->name;
  terms.base_color = dvec3(surface.base.color);
  terms.sheen_color = dvec3(surface.sheen_color);
  terms.metallic = surface.base.metallic;
  terms.roughness = std::sqrt(surface.base.alpha);
  terms.sheen_roughness = surface.sheen_roughness;
  terms.clearcoat = surface.clearcoat;
  terms.clearcoat_roughness = std::sqrt(surface.coat_alpha);
  terms.radiance = dvec3(shade(surface, layers, frame.lighting(factors), TermsListener{terms}).radiance);
  return terms;
}

}  // namespace sheen::golden
