#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "albedo/sheen_model.h"
#include "gles/context.h"
#include "renderer/renderer.h"
#include "tools/tone_map.h"

namespace sheen::tools {

/// A value and its word on the command line and in JSON.
template <class Value>
struct Word {
  const char* text;
  Value value;
};

inline constexpr std::array visibility_words{Word<albedo::Visibility>{"charlie", albedo::Visibility::Charlie},
                                             Word<albedo::Visibility>{"ashikhmin", albedo::Visibility::Ashikhmin},
                                             Word<albedo::Visibility>{"refined", albedo::Visibility::Refined}};
inline constexpr std::array albedo_scaling_words{Word<albedo::AlbedoScaling>{"full", albedo::AlbedoScaling::Full},
                                                 Word<albedo::AlbedoScaling>{"view", albedo::AlbedoScaling::View},
                                                 Word<albedo::AlbedoScaling>{"none", albedo::AlbedoScaling::None},
                                                 Word<albedo::AlbedoScaling>{"literal", albedo::AlbedoScaling::Literal}};
inline constexpr std::array model_words{Word<albedo::Model>{"ratified", albedo::Model::Ratified},
                                        Word<albedo::Model>{"draft-2019", albedo::Model::Draft2019},
                                        Word<albedo::Model>{"physical", albedo::Model::Physical}};
inline constexpr std::array context_words{Word<gles::ContextKind>{"osmesa", gles::ContextKind::OsMesa},
                                          Word<gles::ContextKind>{"egl", gles::ContextKind::Egl}};
inline constexpr std::array precision_words{Word<renderer::Precision>{"highp", renderer::Precision::Highp},
                                            Word<renderer::Precision>{"mediump", renderer::Precision::Mediump}};
inline constexpr std::array formulation_words{Word<renderer::Formulation>{"literal", renderer::Formulation::Literal},
                                              Word<renderer::Formulation>{"stable", renderer::Formulation::Stable}};
inline constexpr std::array albedo_source_words{Word<renderer::AlbedoSource>{"table", renderer::AlbedoSource::Table},
                                                Word<renderer::AlbedoSource>{"fit", renderer::AlbedoSource::Fit}};
inline constexpr std::array tone_map_words{Word<ToneMap>{"none", ToneMap::None},
                                           Word<ToneMap>{"khronos-pbr-neutral", ToneMap::KhronosPbrNeutral}};

/// The word of a value.
template <class Value, std::size_t N>
std::string word_of(const std::array<Word<Value>, N>& words, Value value) {
  for (const Word<Value>& word : words) {
    if (word.value == value) {
      return word.text;
    }
  }
  return {};
}

/// The value of a word, or nothing.
template <class Value, std::size_t N>
std::optional<Value> value_of(const std::array<Word<Value>, N>& words, std::string_view text) {
  for (const Word<Value>& word : words) {
    if (text == word.text) {
      return word.value;
    }
  }
  return std::nullopt;
}

/// All words, in the order in which help lists them.
template <class Value, std::size_t N>
std::vector<std::string> texts(const std::array<Word<Value>, N>& words) {
  std::vector<std::string> all;
  for (const Word<Value>& word : words) {
    all.emplace_back(word.text);
  }
  return all;
}

}  // namespace sheen::tools
