// How far the skin follows a press and a drag in each direction, by what lies under it and how it is folded.
//
// Where the tissue is the same all round and the skin is flat, a region is the circle of a press or the ellipse of a
// drag. Elsewhere a radius is counted along the skin: a millimetre of way is worth 1 / R(t) of it, with R(t) the reach
// in tissue as thick as it is there (thin tissue over a rib is soon crossed), and a drag loses a part of its reach for
// every radian by which the skin folds inward, since what lies beyond a furrow does not follow. The numbers come from
// finite elements of ribs, steps and furrows (docs/explanation/deformation.md).
//
//   skin, bones, library ─ AnatomicalReach, at load ─► World::reach ─ at(), a contact and frame ─► regions, contours
//
// Based on: dissertation 2008, section 6.2 (irregular deformation boundaries as future work).
#pragma once

#include <array>
#include <limits>
#include <span>
#include <vector>

#include "palpate/body/bones.h"
#include "palpate/maps/ellipse.h"
#include "palpate/maps/polar_contour.h"
#include "palpate/tissue/layered_tissue.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::scene {

/// Logarithms of factors on a radius, at equal angles from the first axis of a place.
using DirectedFactors = std::array<double, 8>;

/// How a place changes the regions of flat skin.
struct PlaceReach {
  Vec3 first = Vec3::UnitX();  ///< axes of the tangent plane; first x second is the normal
  Vec3 second = Vec3::UnitY();
  DirectedFactors press{};
  DirectedFactors drag{};
  /// How deep the skin may go, mm, until a tenth of the tissue is left somewhere around: infinite where no bone is.
  double deepest_mm = std::numeric_limits<double>::infinity();
};

/// Requests the reach of a press, a drag or both; ways that neither needs are not walked.
struct ReachRequest {
  const tissue::PressCurves* press = nullptr;
  /// Where a tenth of the drag is left on flat skin; an empty one: no drag.
  maps::SurfaceEllipse drag_tenth = {};
  Vec3 drag = Vec3::Zero();  ///< the way it goes
};

class AnatomicalReach {
 public:
  /// `nearest_mm` (to the nearest bone, a vertex each) and `bones` may both be empty: folds alone count then.
  AnatomicalReach(const mesh::TriangleMesh& skin, const tree::TriangleTree& tree, std::span<const double> nearest_mm,
                  std::span<const body::Bone> bones, const tissue::LayeredTissue& layered);

  /// At a point of a triangle of the skin; `tree` is that of the constructor. Some hundredths of a millisecond on a
  /// million triangles. No allocation; any thread.
  PlaceReach at(const tree::TriangleTree& tree, Index triangle, const Vec3& point, const Vec3& unit_normal,
                const ReachRequest& request) const noexcept;

 private:
  struct Rates;
  struct Growing;
  struct Cover;
  struct Way;
  Rates ratesAt(double log_thickness) const noexcept;
  Rates flatRates(Index triangle, const tree::TriangleTree& tree, const Vec3& point) const noexcept;
  void walk(const tree::TriangleTree& tree, Index record, const Vec3& point, const Vec3& normal, Way& way,
            Cover& cover) const noexcept;

  static constexpr std::size_t kRows = 48;
  std::vector<Index> record_of_triangle_;
  std::vector<float> nearest_mm_;   ///< to the nearest bone, a vertex each; empty without bones
  std::vector<float> log_beneath_;  ///< of the thickness that reaches go by, likewise
  double log_thinnest_ = 0.0;
  double log_step_ = 0.0;
  std::array<double, kRows + 1> press_mm_{};  ///< by the logarithm of the thickness
  std::array<double, kRows + 1> drag_mm_{};
};

/// The region with its radii times the part of the factors that leaves an ellipse an ellipse: the same both ways.
maps::SurfaceEllipse bentEllipse(const maps::SurfaceEllipse& ellipse, const DirectedFactors& factors,
                                 const PlaceReach& place) noexcept;

/// A contour in the place's plane, its radii times all of the factors.
maps::SurfaceContour bentContour(maps::SurfaceContour contour, const DirectedFactors& factors,
                                 const PlaceReach& place) noexcept;

/// The region as a contour, its radii times all of the factors.
maps::SurfaceContour bentContour(const maps::SurfaceEllipse& ellipse, const DirectedFactors& factors,
                                 const PlaceReach& place) noexcept;

}  // namespace palpate::scene
