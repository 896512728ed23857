// A corner on the plane counts as one side of it, so that a section that is inside a triangle leaves it by exactly one
// other edge, whatever the rounding. Of each next triangle only the one corner is asked that was not seen before.
#include "palpate/scene/section_walk.h"

namespace palpate::scene {

namespace {

/// A walk starts this share of the way to the middle of the triangle: at a corner or on an edge, where fingers often
/// are, the triangle itself may lie behind.
constexpr double kInside = 1e-3;

bool differ(double first, double second) { return (first >= 0.0) != (second >= 0.0); }

/// The side of the record that is this edge, seen from its neighbour.
std::size_t entrySide(const tree::TriangleRecord& record, const std::array<Index, 2>& edge) noexcept {
  for (std::size_t i = 0; i < 2; ++i) {
    if (record.vertices[i] == edge[1] && record.vertices[i + 1] == edge[0]) return i;
  }
  return 2;
}

}  // namespace

SectionWalk::SectionWalk(const tree::TriangleTree& tree, Index record, const Vec3& from, const Vec3& normal,
                         const Vec3& ahead) noexcept
    : tree_(tree), from_(from), across_(normal.cross(ahead)) {
  const tree::TriangleRecord& start = tree.records[record];
  from_ += kInside * ((start.corners[0] + start.corners[1] + start.corners[2]) / 3.0 - from);
  double farthest = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const double first = sideOf(start.corners[i]);
    const double second = sideOf(start.corners[j]);
    if (!differ(first, second)) continue;
    const Vec3 point = start.corners[i] + first / (first - second) * (start.corners[j] - start.corners[i]);
    const double distance = ahead.dot(point - from);
    if (record_ != kNoIndex && distance <= farthest) continue;
    record_ = record;
    farthest = distance;
    leaveBy(i, first, second);
  }
}

void SectionWalk::leaveBy(std::size_t edge, double first, double second) noexcept {
  exit_ = edge;
  first_ = first;
  second_ = second;
}

bool SectionWalk::next(Crossing& crossing) noexcept {
  if (record_ == kNoIndex) return false;
  const tree::TriangleRecord& left = tree_.records[record_];
  const std::size_t end = (exit_ + 1) % 3;
  crossing.share = first_ / (first_ - second_);
  crossing.point = left.corners[exit_] + crossing.share * (left.corners[end] - left.corners[exit_]);
  crossing.vertices = {left.vertices[exit_], left.vertices[end]};
  record_ = left.neighbours[exit_];
  if (record_ == kNoIndex) return true;
  const tree::TriangleRecord& record = tree_.records[record_];
  const std::size_t entry = entrySide(record, crossing.vertices);
  const std::size_t third = (entry + 2) % 3;
  const double side = sideOf(record.corners[third]);
  // The edge it came by runs from the old second to the old first corner.
  if (differ(first_, side)) {
    leaveBy((entry + 1) % 3, first_, side);
  } else {
    leaveBy(third, side, second_);
  }
  return true;
}

}  // namespace palpate::scene
