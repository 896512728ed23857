// The first half of building a world: the body as a mesh that can be felt, whether built in or from a file.
#pragma once

#include "palpate/mesh/files/load.h"
#include "palpate/scene/world.h"

namespace palpate::scene {

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
