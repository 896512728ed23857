// A picture on the skin: of a mesh by the file's own texture coordinates, carried over to the skin that was mended and
// reordered; of a built-in body as two photographs side by side. The picture stays as its file holds it. Whoever draws
// decodes it; this room draws nothing.
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

/// The texture of a body on its skin; null when it asks for none. On a built-in body the left half of the picture is
/// the body from behind and the right half the same from the front, both without perspective and each filled from edge
/// to edge by the body's box. Throws Error.
std::shared_ptr<const SkinTexture> loadSkinTexture(const BodySettings& body, const mesh::TriangleMesh& skin,
                                                   const Progress& progress);

}  // namespace palpate::scene
