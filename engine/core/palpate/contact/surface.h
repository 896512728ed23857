// The skin as a finger feels it: its geometry, built once from a fit mesh and shared by every surface of that mesh, and
// what it is made of, which a slider changes. Immutable afterwards, shared by any number of fingers.
//
//   mesh ─ buildGeometry ─► SurfaceGeometry ─┐
//   stiffness, thickness, force law ─────────┴─ surfaceOf ─► Surface
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/mesh/triangle_mesh.h"
#include "palpate/tissue/force_law.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::contact {

struct Lumps;

/// Plain data. Triangles are named by their record in the tree (leaf order).
struct SurfaceGeometry {
  tree::TriangleTree tree;
  std::vector<Vec3> vertex_normals;            ///< unit, weighted by angle: their side test is exact at a vertex
  std::vector<std::uint8_t> vertex_on_border;  ///< 1 where the sheet ends
  bool self_intersecting = false;
  /// Per record: 1 in and next to the sheets that pierce each other or lie doubled in one plane, where a point is felt
  /// as a very small sphere (docs/explanation/contact.md). Empty where none pierce.
  std::vector<std::uint8_t> entangled;
  /// Per record: 1 where a crack is too narrow for a finger (narrow_cracks.h). Empty where there are none.
  std::vector<std::uint8_t> cracked;
  bool closed = false;  ///< no border anywhere
  /// Two fans share a vertex's place, or two joints share an edge's: the body touches itself there without piercing, as
  /// the voxels of a segmented scan do. A proxy there may bound two empty sectors at once (sides.h: isInAir).
  bool touches_itself = false;
};

struct SkinPlanes;

/// Shared by all fingers, which only read it.
struct Surface {
  std::shared_ptr<const SurfaceGeometry> geometry;  ///< never null
  /// Per vertex; never null. Surfaces of one skin may share it.
  std::shared_ptr<const std::vector<double>> stiffness_n_per_mm;
  std::vector<double> tissue_mm;  ///< per vertex: felt over the bone (PlacedTissue); empty where it is not known
  tissue::ForceLaw force_law;
  std::shared_ptr<const Lumps> lumps = nullptr;  ///< under it (lump_force.h); null: none
  /// For spheres that keep the skin near them (nearby_skin.h); null: they search the tree.
  std::shared_ptr<const SkinPlanes> planes = nullptr;
};

/// `mesh` must be fit for contact, as mesh::repair leaves it: an edge has at most one neighbour on each side and the
/// triangles of a vertex form one fan. Throws Error otherwise. `self_intersecting`: false if the caller knows that no
/// sheets of the surface pierce each other; otherwise the mesh is searched for them (about 1 us per triangle).
/// `progress` is called about every 0.2 s; an exception from it ends the work.
std::shared_ptr<const SurfaceGeometry> buildGeometry(const mesh::TriangleMesh& mesh,
                                                     std::optional<bool> self_intersecting = {},
                                                     const Progress& progress = {});

struct SurfaceOptions {
  tissue::ForceLaw force_law = {};
  std::optional<bool> self_intersecting = {};  ///< as buildGeometry has it
  /// Per vertex, finite and >= 0: the thickness over the bone, for the layered law. May be empty.
  std::vector<double> tissue_mm = {};
  std::shared_ptr<const Lumps> lumps = nullptr;
};

/// One stiffness (and thickness) per vertex, finite and >= 0. Throws Error otherwise.
Surface surfaceOf(std::shared_ptr<const SurfaceGeometry> geometry, std::vector<double> stiffness_n_per_mm,
                  SurfaceOptions options = {});
Surface surfaceOf(std::shared_ptr<const SurfaceGeometry> geometry,
                  std::shared_ptr<const std::vector<double>> stiffness_n_per_mm, SurfaceOptions options = {});

/// Both at once.
Surface buildSurface(const mesh::TriangleMesh& mesh, std::vector<double> stiffness_n_per_mm,
                     SurfaceOptions options = {});

}  // namespace palpate::contact
