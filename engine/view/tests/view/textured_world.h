// Worlds whose skin wears a picture.
#pragma once

#include "palpate/base/text.h"
#include "palpate/scene/skin_texture.h"
#include "palpate/view/image.h"
#include "support/changed_body.h"
#include "support/temporary_folder.h"
#include "support/textured_bytes.h"
#include "view/tests/view/small_world.h"

namespace palpate::view {

/// The size of the pictures that are taken of them.
inline constexpr int kTexturedWidth = 320;
inline constexpr int kTexturedHeight = 240;
inline constexpr double kTexturedAspect = static_cast<double>(kTexturedWidth) / kTexturedHeight;

inline std::string pngBytes(const Image& image) {
  const support::TemporaryFolder folder;
  writePng(folder / "x.png", image);
  return readFile(folder / "x.png", 1 << 24);
}

/// `picture`: the bytes of its file.
inline std::shared_ptr<const scene::World> texturedWorld(const mesh::TriangleMesh& mesh, const support::TextureLaw& law,
                                                         const std::string& picture) {
  auto world = std::make_shared<scene::World>(*meshWorld(mesh));
  scene::SkinTexture texture;
  texture.source.file = "picture.png";
  texture.source.scene_file = "s.toml";
  texture.source.line = 4;
  texture.picture = picture;
  texture.corners = support::cornersBy(law, mesh);
  support::changeBody(*world, [&](scene::Body& body) {
    body.texture = std::make_shared<const scene::SkinTexture>(std::move(texture));
  });
  return world;
}

}  // namespace palpate::view
