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

/// At rest when made, written by Deformer::apply. Several may exist of one skin (double buffering): each remembers its
/// own changes. Vertex order is the mesh's. Arrays start on a cache line.
class DeformedSurface {
 public:
  DeformedSurface() = default;
  explicit DeformedSurface(const Skin& skin);

  Index vertices() const { return vertices_; }
  /// Origin of the positions: the skin's, zero but for a body far away (Skin::origin).
  const Vec3& origin() const { return origin_; }
  /// Axis 0, 1, 2 = x, y, z; mm from the origin. Vertices that no contact touches hold the rest shape bit by bit.
  std::span<const float> position(int axis) const { return view(kPosition + axis); }
  /// Unit normals.
  std::span<const float> normal(int axis) const { return view(kNormal + axis); }
  /// mm; exactly 0 outside the regions.
  std::span<const float> displacement(int axis) const { return view(kDisplacement + axis); }
  /// Strain of the skin around the vertex, > 0 is tension: mean of its edges (4.20), or principal (StrainKind); 0
  /// unless the deformer computes strain.
  std::span<const float> strain() const { return view(kStrain); }

  Vec3f positionAt(Index v) const { return at(kPosition, v); }
  /// In the body frame.
  Vec3 placeAt(Index v) const { return origin_ + positionAt(v).cast<double>(); }
  Vec3f normalAt(Index v) const { return at(kNormal, v); }
  Vec3f displacementAt(Index v) const { return at(kDisplacement, v); }

  /// Ranges that the last apply wrote, in whole blocks of 64 vertices: ascending, disjoint, not adjacent. Upload these.
  std::span<const VertexRange> changed() const { return changed_; }

 private:
  friend class Deformer;
  /// Where the arrays of a quantity begin in streams_.
  enum Stream { kPosition = 0, kNormal = 3, kDisplacement = 6, kStrain = 9, kStreams = 10 };

  std::span<const float> view(int stream) const { return {streams_[stream], vertices_}; }
  Vec3f at(Stream first, Index v) const { return {streams_[first][v], streams_[first + 1][v], streams_[first + 2][v]}; }
  PositionStreams axes(Stream first) const { return {streams_[first], streams_[first + 1], streams_[first + 2]}; }
  DeformedBlock block(Index block);
  PositionStreams positions() const { return axes(kPosition); }
  PositionStreams displacements() const { return axes(kDisplacement); }
  void setNormal(Index v, const Vec3f& normal);
  void setStrain(Index v, float strain);
  /// Zero everywhere: for a deformer that writes none.
  void forgetStrain();
  void restore(const Skin& skin, Index block);
  void listChange(Index block);

  Index vertices_ = 0;
  Vec3 origin_ = Vec3::Zero();
  FloatStreams streams_;  // x y z, nx ny nz, dx dy dz, strain
  BlockSet written_;      // blocks that do not hold the rest shape
  bool has_strain_ = false;
  std::vector<VertexRange> changed_;
};

}  // namespace palpate::deform
