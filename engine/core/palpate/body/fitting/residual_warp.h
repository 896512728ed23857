// The residual between a fitted build and the scan, as a smooth warp of space that moves skin, landmarks and bones.
//
// body_fit.h makes one, fitted_body.h uses it.
#pragma once

#include <vector>

#include "palpate/base/vec.h"

namespace palpate::body {

/// A place (mm, the scan's frame) and where it belongs.
struct Move {
  Vec3 place;
  Vec3 by;
};

class ResidualWarp {
 public:
  ResidualWarp() = default;
  /// `skin`: samples of the skin; their moves are averaged over kSkinReachMm. `exact`: goes through these exactly,
  /// after the skin's part; few.
  ResidualWarp(std::vector<Move> skin, std::vector<Move> exact);

  Vec3 operator()(const Vec3& point) const;

  /// As given, for a file.
  const std::vector<Move>& skin() const { return skin_; }
  const std::vector<Move>& exact() const { return exact_; }

 private:
  Vec3 bySkin(const Vec3& point) const;

  std::vector<Move> skin_, exact_;
  std::vector<Vec3> weights_;  // kernel weights at the exact places
};

}  // namespace palpate::body
