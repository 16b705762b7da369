#pragma once

// The words that features, defines and shader files are named with.

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string>

#include "albedo/sheen_model.h"

namespace sheen::renderer {

inline std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

inline const char* visibility_name(albedo::Visibility visibility) {
  switch (visibility) {
    case albedo::Visibility::Charlie:
      return "charlie";
    case albedo::Visibility::Ashikhmin:
      return "ashikhmin";
    case albedo::Visibility::Refined:
      return "refined";
  }
  throw std::invalid_argument("unknown visibility");
}

inline const char* scaling_name(albedo::AlbedoScaling scaling) {
  switch (scaling) {
    case albedo::AlbedoScaling::Full:
      return "full";
    case albedo::AlbedoScaling::View:
      return "view";
    case albedo::AlbedoScaling::None:
      return "none";
    case albedo::AlbedoScaling::Literal:
      return "literal";
  }
  throw std::invalid_argument("unknown albedo scaling");
}

}  // namespace sheen::renderer
