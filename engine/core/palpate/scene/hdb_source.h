// The contact source "hdb" needs more than the surface: the partition, the size of the box and the errata of chapter 3
// that the scene takes literally.
#pragma once

#include <memory>
#include <string>

#include "palpate/base/progress.h"
#include "palpate/hdb/hdb_candidates.h"
#include "palpate/scene/scene.h"

namespace palpate::scene {

/// Throws Error for what that source cannot do: a finger with a radius, force shading. Nothing for another source.
void checkContactSource(const Scene& scene);

/// Throws Error as checkContactSource, and for a traversal that does not suit the tree or the query.
std::shared_ptr<const hdb::HdbSurface> buildHdbSource(const Scene& scene, const mesh::TriangleMesh& skin,
                                                      const contact::Surface& surface, const Progress& progress = {});

/// For reports: "touched through a detecting box of 150 mm: octree of 13 leaves".
std::string describe(const hdb::HdbSurface& source);

}  // namespace palpate::scene
