// A picture on the skin of a mesh: the file's own texture coordinates, carried over to the skin that was mended and
// reordered, and the picture as its file holds it. Whoever draws decodes the picture; this room draws nothing.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/mesh/textured_mesh.h"
#include "palpate/scene/scene.h"

namespace palpate::scene {

struct SkinTexture {
  TextureSource source;
  std::string picture;                        ///< the bytes of a PNG or JPEG file
  std::vector<mesh::TextureCorners> corners;  ///< a triangle of the skin each
};

/// Throws Error: where the scene file names the texture, which file that is, and what is wrong with it.
[[noreturn]] void failForTexture(const TextureSource& source, std::string_view cause);

/// The texture of a body from a mesh file, on its skin; null when the body asks for none. Throws Error.
std::shared_ptr<const SkinTexture> loadSkinTexture(const BodySettings& body, const mesh::TriangleMesh& skin,
                                                   const Progress& progress);

}  // namespace palpate::scene
