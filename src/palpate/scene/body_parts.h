// The first half of building a world: the body as a mesh that can be felt, whether built in or from a file.
#pragma once

#include "palpate/mesh/files/load.h"
#include "palpate/scene/world.h"

namespace palpate::scene {

/// What becomes the world's skin.
struct BodyParts {
  std::string name;
  mesh::TriangleMesh skin;
  bool closed = false;
  bool self_intersecting = false;
  Anatomy anatomy;
  std::vector<std::string> notes;
  std::shared_ptr<const SkinTexture> texture;
};

/// How the body's mesh file is read.
mesh::LoadOptions loadOptionsOf(const BodySettings& settings);

/// Throws Error naming the file when there is one.
BodyParts makeBody(const BodySettings& settings, const Progress& progress);

}  // namespace palpate::scene
