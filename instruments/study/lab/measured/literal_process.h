// The dissertation's haptic process, frame by frame: every triangle of the leaves that the detecting box meets is
// tested, each by itself, as a haptic library has to do with whatever was drawn (3.3, 3.3.4).
//
// "Untouched" is collision detection: the way of the tip against every triangle. "Touched" adds the generation of the
// force: the nearest point of every triangle, then spring and friction. The real work of the library of 2008 on its
// triangles was never published; this is the least it had to do.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "lab/literal/mesh.h"
#include "palpate/hdb/haptic_box.h"

namespace palpate::study {

/// Haptically drawn triangles of a frame: those of some leaves, or of the whole model.
using RenderedLeaves = std::vector<std::span<const Index>>;

RenderedLeaves wholeModel(const std::vector<Index>& all_triangles);
RenderedLeaves collectHitLeaves(const hdb::Partition& partition, const hdb::LeafHits& hits);
std::size_t countTriangles(const RenderedLeaves& leaves);

struct LiteralHit {
  Vec3 point = Vec3::Zero();
  double fraction = 1.0;  ///< share of the way
  Index triangle = kNoIndex;
};

/// Collision detection: where the way from `from` to `to` first meets the front of a triangle.
LiteralHit collide(const bench::literal::Mesh& mesh, const RenderedLeaves& leaves, const Vec3& from, const Vec3& to);

/// Force generation: spring and friction from the nearest point of all triangles; zero for no triangles.
Vec3 touchForce(const bench::literal::Mesh& mesh, const RenderedLeaves& leaves, const Vec3& tip, const Vec3& anchor);

}  // namespace palpate::study
