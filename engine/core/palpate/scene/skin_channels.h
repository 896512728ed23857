// Numbers and colours per vertex from the body's own PLY, carried over to the repaired and reordered skin, and the
// vertex of the file that each vertex of the skin was.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/mesh/files/vertex_channels.h"

namespace palpate::scene {

/// One number a vertex of the skin.
struct SkinScalar {
  static constexpr std::size_t kBins = 48;

  std::string name;
  std::vector<float> values;
  // Range of the finite values; 0 and 0 if none is finite.
  double least = 0.0;
  double greatest = 0.0;
  std::array<std::size_t, kBins> histogram{};  ///< vertices in equal parts from the least to the greatest
};

struct SkinChannels {
  std::vector<SkinScalar> scalars;
  std::vector<std::array<std::uint8_t, 3>> colours;  ///< sRGB, a vertex each; empty = none
  std::vector<Index> source_vertex;                  ///< a vertex each: its number in the file, from 0
};

/// `of_file` has an entry a vertex of the file.
std::shared_ptr<const SkinChannels> skinChannels(const mesh::VertexChannels& of_file, std::vector<Index> source_vertex);

/// The scalar of this name; with an empty name the first. Null where there is none, or no channels at all.
const SkinScalar* scalarNamed(const SkinChannels* channels, std::string_view name);

/// "a, b, c", or "none".
std::string scalarNames(const SkinChannels* channels);

}  // namespace palpate::scene
