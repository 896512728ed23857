#include "palpate/view/skin_chunks.h"

#include <algorithm>
#include <array>

namespace palpate::view {

namespace {

/// About a fingertip across on a back of 40,000 triangles.
constexpr Index kChunkTriangles = 64;
constexpr Index kChunkIndices = 3 * kChunkTriangles;
/// Skin moves no farther (the default caps of 10 and 20 mm together).
constexpr float kMostDisplacementMm = 25.0f;
/// Skin that moves farther than this lies so near the finger that it counts as touched where it was.
constexpr float kTouchedDisplacementMm = 12.0f;

using Planes = std::array<Eigen::Vector4f, 6>;

/// Inside is positive; lengths in mm.
Planes planesOf(const Mat4f& clip) {
  Planes planes;
  for (int axis = 0; axis < 3; ++axis) {
    planes[2 * axis] = clip.row(3) + clip.row(axis);
    planes[2 * axis + 1] = clip.row(3) - clip.row(axis);
  }
  for (Eigen::Vector4f& plane : planes) plane /= plane.head<3>().norm();
  return planes;
}

bool mayBeSeen(const Planes& planes, const Vec3f& centre, float radius) {
  return std::all_of(planes.begin(), planes.end(),
                     [&](const auto& plane) { return plane.dot(centre.homogeneous()) > -radius; });
}

bool isNear(const Influence& influence, const Vec3f& centre, float radius) {
  const Vec3f along = influence.to - influence.from;
  const float squared = along.squaredNorm();
  const float t = squared > 0.0f ? std::clamp((centre - influence.from).dot(along) / squared, 0.0f, 1.0f) : 0.0f;
  return (influence.from + t * along - centre).norm() < radius + influence.radius_mm;
}

void append(std::vector<IndexRun>& runs, Index first, Index count) {
  if (!runs.empty() && runs.back().first + runs.back().count == first) {
    runs.back().count += count;
  } else {
    runs.push_back({first, count});
  }
}

}  // namespace

SkinChunks::SkinChunks(const deform::Skin& skin) : indices_(static_cast<Index>(3 * skin.triangles.size())) {
  for (std::size_t first = 0; first < skin.triangles.size(); first += kChunkTriangles) {
    const std::size_t end = std::min(first + kChunkTriangles, skin.triangles.size());
    Eigen::AlignedBox3f box;
    for (std::size_t t = first; t < end; ++t) {
      for (const Index v : skin.triangles[t]) box.extend(skin.restPosition(v));
    }
    chunks_.push_back({box.center(), 0.5f * box.diagonal().norm()});
  }
}

const SplitRuns& SkinChunks::split(const Mat4f& clip, std::span<const Influence> influences) {
  const Planes planes = planesOf(clip);
  runs_.touched.clear();
  runs_.plain.clear();
  for (std::size_t i = 0; i < chunks_.size(); ++i) {
    const Chunk& chunk = chunks_[i];
    if (!mayBeSeen(planes, chunk.centre, chunk.radius_mm + kMostDisplacementMm)) continue;
    const bool touched = std::any_of(influences.begin(), influences.end(), [&](const Influence& influence) {
      return isNear(influence, chunk.centre, chunk.radius_mm + kTouchedDisplacementMm);
    });
    const Index first = static_cast<Index>(i) * kChunkIndices;
    append(touched ? runs_.touched : runs_.plain, first, std::min(kChunkIndices, indices_ - first));
  }
  return runs_;
}

}  // namespace palpate::view
