#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "conformance/case.h"
#include "golden/golden.h"
#include "image/image.h"
#include "scene/scene.h"

namespace sheen::conformance {

/// What goldens/manifest.json says of the committed goldens.
struct Manifest {
  struct Entry {
    std::string file;        ///< relative to the manifest's folder
    std::string scene_hash;  ///< scene::content_hash
    std::string settings;    ///< settings_text()
  };
  std::string formula_version;
  std::string suite;
  std::map<std::string, Entry> cases;
};

/// Reads DIR/manifest.json; nothing when there is none. Throws std::runtime_error naming the file when it is malformed.
std::optional<Manifest> read_manifest(const std::filesystem::path& dir);
/// Writes DIR/manifest.json.
void write_manifest(const std::filesystem::path& dir, const Manifest& manifest);

/// Relative standard error that 99 % of a golden's pixels meet under an image.
inline constexpr double golden_error = 0.0025;

/// The settings a golden of the case is computed with. @param drawn_directions  of a viewer that draws an environment as ours does, else 0
golden::Settings golden_settings(const Case& one, const albedo::SheenModel& model, int subpixel_bits, int drawn_directions = 0);
/// What of them its radiance depends on, as text: "128x128 camera 0 charlie full"; a model other than the ratified one is named last.
std::string settings_text(const golden::Settings& settings);

/// What judges a candidate: RGBA (committed, if that is what the manifest promises, else computed), bounds and exclusions (always
/// computed).
struct Reference {
  image::Image image;
  bool pxr24 = false;   ///< RGBA are a committed golden's
  std::string problem;  ///< the committed golden and the computed one disagree: nothing can be judged by it
};

/// Goldens, computed on demand and kept in a cache folder, keyed by scene, settings and formula version. Safe to use from many threads.
class GoldenStore {
 public:
  /// @param cache      folder of computed goldens; a folder that cannot be written is done without
  /// @param committed  folder of committed goldens; empty: none
  GoldenStore(std::filesystem::path cache, std::filesystem::path committed, std::string suite);

  /// Computes the golden, or reads it from the cache. @param hash  of the scene
  image::Image computed(const scene::Scene& scene, const std::string& hash, const golden::Settings& settings) const;
  /// The reference of the case as asked for.
  Reference reference(const Case& one, const scene::Scene& scene, const std::string& hash, const golden::Settings& settings) const;

 private:
  std::filesystem::path cache_;
  std::filesystem::path committed_;
  std::string suite_;
  std::optional<Manifest> manifest_;
};

/// Whether a committed golden holds the computed one's RGBA: PXR24 rounds by at most 2^-16 of a value, and another machine's last bit
/// (2^-23) may tip it. Says where not; empty when it does.
std::string disagreement(const image::Image& committed, const image::Image& computed);

}  // namespace sheen::conformance
