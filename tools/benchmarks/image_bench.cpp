// Picture files and metrics, 512 x 512. The first write also loads the image library, so one is done before the clock starts.
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

#include <benchmark/benchmark.h>

#include "image/image.h"
#include "image/io.h"
#include "image/metrics.h"

namespace {

sheen::image::Image gradient(float gain) {
  sheen::image::Image picture(512, 512, {"R", "G", "B", "A"});
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      picture.at(x, y, 0) = gain * static_cast<float>(x) / 511.0f;
      picture.at(x, y, 1) = gain * static_cast<float>(y) / 511.0f;
      picture.at(x, y, 2) = gain * static_cast<float>((x * 7 + y * 13) % 512) / 511.0f;
      picture.at(x, y, 3) = 1.0f;
    }
  }
  return picture;
}

void image_write(benchmark::State& state, const std::string& name) {
  std::string folder = (std::filesystem::temp_directory_path() / "sheen-cts-bench-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) {
    state.SkipWithError("no temporary folder");
    return;
  }
  const std::filesystem::path file = std::filesystem::path(folder) / name;
  const sheen::image::Image picture = gradient(1.0f);
  sheen::image::write(file, picture);
  for ([[maybe_unused]] auto step : state) {
    sheen::image::write(file, picture);
  }
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
}
BENCHMARK_CAPTURE(image_write, exr, std::string("picture.exr"))->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(image_write, png, std::string("picture.png"))->Unit(benchmark::kMillisecond)->UseRealTime();

void image_compare(benchmark::State& state, float gain) {
  const sheen::image::Image reference = gradient(gain);
  const sheen::image::Image candidate = gradient(gain * 1.001f);
  for ([[maybe_unused]] auto step : state) {
    benchmark::DoNotOptimize(sheen::image::compare(candidate, reference));
  }
}
BENCHMARK_CAPTURE(image_compare, ldr_flip, 0.99f)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(image_compare, hdr_flip, 20.0f)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
