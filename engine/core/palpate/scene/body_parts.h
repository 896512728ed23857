// The first half of building a world: the body as a mesh that can be felt, whether built in or from a file.
#pragma once

#include "palpate/mesh/files/load.h"
#include "palpate/scene/world.h"

namespace palpate::scene {

/// The parts that become the world's skin.
struct BodyParts {
  std::string name;
  mesh::TriangleMesh skin;
  bool closed = false;
  bool self_intersecting = false;
  Anatomy anatomy;
  std::vector<std::string> notes;
  std::shared_ptr<const SkinTexture> texture;
  std::shared_ptr<const SkinChannels> channels = nullptr;
  std::vector<double> given_stiffness_n_per_mm = {};  ///< a skin vertex each, in place of the scene's; or empty
  /// Layered tissue in place of the library's and the scene's table; or null.
  std::shared_ptr<const tissue::LayeredTissue> given_layers = nullptr;
};

/// Whether "made:scan" stands in the place of the mesh file: a scan that the program makes (body/fitting/made_scan.h).
bool isMadeScan(const BodySettings& settings);

/// How the body's mesh file is read.
mesh::LoadOptions loadOptionsOf(const BodySettings& settings);

/// Any mesh, made fit for contact and ordered in space. `source_vertex` gets for each vertex of the skin the one of
/// `mesh` that it is. Throws Error when nothing is left to feel.
BodyParts mendedBody(mesh::TriangleMesh mesh, std::string name, const Progress& progress,
                     std::vector<Index>& source_vertex);

/// build on a body that is there already; `scene.body` says only of which kind it is.
std::shared_ptr<const World> buildOn(const Scene& scene, BodyParts body, const Progress& progress = {});

/// Throws Error naming the file when there is one.
BodyParts makeBody(const BodySettings& settings, const Progress& progress);

}  // namespace palpate::scene
