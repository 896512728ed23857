// The skin is gathered into patches: all of its area that is in one cell of a grid and faces one of six ways. Each
// patch computes how much of its sky every other one covers, and the vertices read the patches round them.
//
// Based on: Bunnell, "Dynamic ambient occlusion and indirect lighting", GPU Gems 2, 2005 (surfaces as discs that cover
// each other's sky).
#include "palpate/view/layers/skin_tint.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace palpate::view {

namespace {

/// Cells along the diagonal of the body: a trunk's are 16 mm wide.
constexpr float kCellsAlong = 56.0f;
constexpr int kWays = 6;
/// A neighbour nearer than its own size is the same piece of skin.
constexpr float kMinSizes = 0.6f;

struct Patch {
  Vec3f place = Vec3f::Zero();   // first a sum by area
  Vec3f normal = Vec3f::Zero();  // the same
  float area = 0.0f;
  float open = 1.0f;
};

int dominantDirection(const Vec3f& normal) {
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  return 2 * axis + (normal[axis] < 0.0f ? 1 : 0);
}

class PatchGrid {
 public:
  explicit PatchGrid(const deform::Skin& skin) {
    Eigen::AlignedBox3f box;
    for (Index v = 0; v < skin.vertices; ++v) {
      if (skin.restPosition(v).allFinite()) box.extend(skin.restPosition(v));
    }
    if (box.isEmpty() || !(box.diagonal().norm() > 0.0f)) return;
    cell_mm_ = box.diagonal().norm() / kCellsAlong;
    low_ = box.min() - Vec3f::Constant(cell_mm_);
    cells_ = (box.sizes() / cell_mm_).array().ceil().cast<int>() + 3;
    patch_at_.assign(static_cast<std::size_t>(cells_.prod()) * kWays, -1);
    gather(skin);
    shade();
  }

  /// The mean of the patches in the eight cells round a place that face the same way.
  float openAt(const Vec3f& place, const Vec3f& normal) const {
    if (patches_.empty() || !place.allFinite()) return 1.0f;
    const Vec3f at = (place - low_) / cell_mm_ - Vec3f::Constant(0.5f);
    const Eigen::Vector3i base = at.array().floor().cast<int>();
    float sum = 0.0f;
    float weights = 1e-6f;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3i cell = base + Eigen::Vector3i(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
      const Vec3f near = (Vec3f::Ones() - (at - cell.cast<float>()).cwiseAbs()).cwiseMax(0.0f);
      for (int way = 0; way < kWays; ++way) {
        const int patch = patch_at_[indexOf(cell, way)];
        if (patch < 0) continue;
        const float alike = std::max(patches_[patch].normal.dot(normal), 0.0f);
        const float weight = near.prod() * alike * alike * std::min(patches_[patch].area, cell_mm_ * cell_mm_);
        sum += weight * patches_[patch].open;
        weights += weight;
      }
    }
    return weights > 1e-5f ? sum / weights : 1.0f;
  }

 private:
  std::size_t indexOf(const Eigen::Vector3i& cell, int way) const {
    const Eigen::Vector3i in = cell.cwiseMax(0).cwiseMin(cells_ - Eigen::Vector3i::Ones());
    const auto wide = in.cast<std::size_t>();
    const auto extent = cells_.cast<std::size_t>();
    const std::size_t flat = wide.x() + extent.x() * (wide.y() + extent.y() * wide.z());
    return flat * kWays + static_cast<std::size_t>(way);
  }

  void gather(const deform::Skin& skin) {
    for (const Triangle& t : skin.triangles) {
      const Vec3f a = skin.restPosition(t[0]);
      const Vec3f across = (skin.restPosition(t[1]) - a).cross(skin.restPosition(t[2]) - a);
      const float area = 0.5f * across.norm();
      if (!(area > 0.0f) || !std::isfinite(area)) continue;
      const Vec3f middle = (a + skin.restPosition(t[1]) + skin.restPosition(t[2])) / 3.0f;
      const Eigen::Vector3i cell = ((middle - low_) / cell_mm_).array().floor().cast<int>();
      int& patch = patch_at_[indexOf(cell, dominantDirection(across))];
      if (patch < 0) {
        patch = static_cast<int>(patches_.size());
        patches_.emplace_back();
      }
      patches_[patch].place += area * middle;
      patches_[patch].normal += 0.5f * across;
      patches_[patch].area += area;
    }
    for (Patch& patch : patches_) {
      patch.place /= patch.area;
      patch.normal.normalize();
    }
  }

  void shade() {
    const float least = kMinSizes * cell_mm_ * kMinSizes * cell_mm_;
    for (Patch& to : patches_) {
      float covered = 0.0f;
      for (const Patch& from : patches_) {
        const Vec3f way = from.place - to.place;
        const float squared = way.squaredNorm();
        const float rises = way.dot(to.normal);
        const float faces = -way.dot(from.normal);
        if (rises <= 0.0f || faces <= 0.0f || squared < least) continue;
        covered += rises * faces * from.area / (squared * (std::numbers::pi_v<float> * squared + from.area));
      }
      to.open = std::max(0.0f, 1.0f - covered);
    }
  }

  float cell_mm_ = 1.0f;
  Vec3f low_ = Vec3f::Zero();
  Eigen::Vector3i cells_ = Eigen::Vector3i::Zero();
  std::vector<int> patch_at_;
  std::vector<Patch> patches_;
};

}  // namespace

std::vector<float> skyLeft(const deform::Skin& skin) {
  const PatchGrid grid(skin);
  std::vector<float> open(skin.vertices, 1.0f);
  for (Index v = 0; v < skin.vertices; ++v) open[v] = grid.openAt(skin.restPosition(v), skin.restNormal(v));
  return open;
}

}  // namespace palpate::view
