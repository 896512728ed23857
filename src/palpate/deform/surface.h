// The deformed skin as it is drawn and written to files: arrays of floats, and what changed in them.
#pragma once

#include <span>

#include "palpate/deform/normals.h"

namespace palpate::deform {

/// Vertices first <= v < end.
struct VertexRange {
  Index first;
  Index end;
};

/// At rest when made, written by Deformer::apply. Several may exist of one skin (double buffering): each remembers
/// what was done to it. Vertex order is the mesh's. Arrays start on a cache line.
class DeformedSurface {
 public:
  DeformedSurface() = default;
  explicit DeformedSurface(const Skin& skin);

  Index vertices() const { return vertices_; }
  /// Axis 0, 1, 2 = x, y, z; mm. Vertices that no contact touches hold the rest shape bit by bit.
  std::span<const float> position(int axis) const { return view(axis); }
  /// Unit normals.
  std::span<const float> normal(int axis) const { return view(3 + axis); }
  /// mm; exactly 0 outside the regions.
  std::span<const float> displacement(int axis) const { return view(6 + axis); }
  /// Strain of the skin around the vertex, > 0 is tension: mean of its edges (4.20), or principal (StrainKind); 0
  /// unless the deformer was asked for strain.
  std::span<const float> strain() const { return view(9); }

  Vec3f positionAt(Index v) const { return {streams_[0][v], streams_[1][v], streams_[2][v]}; }
  Vec3f normalAt(Index v) const { return {streams_[3][v], streams_[4][v], streams_[5][v]}; }
  Vec3f displacementAt(Index v) const { return {streams_[6][v], streams_[7][v], streams_[8][v]}; }

  /// What the last apply wrote, in whole blocks of 64 vertices: ascending, disjoint, not adjacent. Upload these.
  std::span<const VertexRange> changed() const { return changed_; }

 private:
  friend class Deformer;
  std::span<const float> view(int stream) const { return {streams_[stream], vertices_}; }
  DeformedBlock block(Index block);
  PositionStreams positions() const { return {streams_[0], streams_[1], streams_[2]}; }
  PositionStreams displacements() const { return {streams_[6], streams_[7], streams_[8]}; }
  void setNormal(Index v, const Vec3f& normal);
  void setStrain(Index v, float strain);
  /// Zero everywhere: for a deformer that writes none.
  void forgetStrain();
  void restore(const Skin& skin, Index block);
  void listChange(Index block);

  Index vertices_ = 0;
  FloatStreams streams_;  // x y z, nx ny nz, dx dy dz, strain
  BlockSet written_;      // blocks that do not hold the rest shape
  bool has_strain_ = false;
  std::vector<VertexRange> changed_;
};

}  // namespace palpate::deform
