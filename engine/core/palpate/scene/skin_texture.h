// A picture on the skin: of a mesh by the file's own texture coordinates, carried over to the skin that was mended and
// reordered; of a built-in body as two photographs side by side. The picture stays as its file holds it. The
// renderer decodes it; the core draws nothing.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/body/torso.h"
#include "palpate/mesh/textured_mesh.h"
#include "palpate/scene/scene.h"

namespace palpate::scene {

/// Inputs of a painted skin: the seed, and the body that it is for.
struct MadeSkin {
  std::uint64_t seed = 1;
  Vec2 size_mm = Vec2::Ones();      ///< of the body's box, across and up
  std::vector<Vec2> spine_mm = {};  ///< skin over the spinous processes, from above, from the box's lower left corner
};

struct SkinTexture {
  TextureSource source;
  std::string picture;                        ///< the bytes of a PNG or JPEG file; empty where it is made
  std::vector<mesh::TextureCorners> corners;  ///< a triangle of the skin each
  std::optional<MadeSkin> made = {};          ///< the renderer paints the picture (view/made_skin.h)
};

/// Throws Error: where the scene file names the texture, which file that is, and what is wrong with it.
[[noreturn]] void failForTexture(const TextureSource& source, std::string_view cause);

/// The seed of a skin that the program paints, where that stands in the place of a file: "made", or "made:7". Throws
/// Error for a seed that is not a whole number.
std::optional<std::uint64_t> madeSeed(const TextureSource& source);

/// The texture of a body on its skin; null when it asks for none. On a built-in body the left half of the picture is
/// the body from behind and the right half the same from the front, both without perspective and each filled from edge
/// to edge by the body's box; so is one that is painted. Throws Error.
std::shared_ptr<const SkinTexture> loadSkinTexture(const BodySettings& body, const mesh::TriangleMesh& skin,
                                                   std::span<const body::SkinLandmark> landmarks,
                                                   const Progress& progress);

}  // namespace palpate::scene
