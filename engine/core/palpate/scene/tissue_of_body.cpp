// The ellipse map says how far the skin of a place follows a drag, and in what direction farther: it was measured where
// a tenth of the drag was left, and with drags along the spine. So the rim lies beyond it, and of the measured ellipse
// the part that any drag makes, longer along itself, is taken out and put back along the drag at hand.
// Based on: dissertation, future work 1 and 3; tenth: E20, the 2 mm contour of a 20 mm drag; elongation: finite
// elements (docs/explanation/tissue.md).
#include "palpate/scene/tissue_of_body.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "palpate/base/elementary.h"
#include "palpate/base/error.h"
#include "palpate/maps/ellipse.h"
#include "palpate/scene/anatomical_reach.h"
#include "palpate/tissue/layered_library.h"

namespace palpate::scene {

namespace {

/// The rim of a drag lies no farther than this, mm: beyond begin a trunk's flanks and arms. Where people were measured
/// with a longer reach than it allows for, a tenth of the drag is left nearer than where they had it; of a person whose
/// own points are given it is left where it was measured (widenToTenth).
constexpr double kFarthestRimMm = 160.0;
/// Drags shorter than this have no direction yet, mm.
constexpr double kShortestDragMm = 1e-6;

double thicknessAt(const World& world, const deform::Contact& contact) noexcept {
  if (contact.anchor_triangle >= world.body->skin.triangles.size()) return world.layered->thickest();
  const Triangle& corners = world.body->skin.triangles[contact.anchor_triangle];
  const std::array<Vec3, 3> at = {world.body->skin.positions[corners[0]], world.body->skin.positions[corners[1]],
                                  world.body->skin.positions[corners[2]]};
  const Vec3 weights = tree::barycentricWeights(at, contact.anchor);
  double thickness = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    thickness += weights[static_cast<Eigen::Index>(i)] * world.surface.tissue_mm[corners[i]];
  }
  return thickness;
}

/// A matrix that takes the unit circle of the tangent plane to an ellipse.
using Mat2 = Eigen::Matrix2d;

/// Longer by `stretch` along a unit direction, and as much shorter across.
Mat2 stretched(const Vec2& along, double stretch) noexcept {
  const Mat2 projection = along * along.transpose();
  return stretch * projection + (Mat2::Identity() - projection) / stretch;
}

/// The ellipse that a matrix makes of the unit circle: its longer half axis and the ratio of the two.
maps::SurfaceEllipse ellipseOf(const Mat2& shape, const Vec3& first, const Vec3& second) noexcept {
  const Mat2 square = shape * shape.transpose();
  const double mean = 0.5 * (square(0, 0) + square(1, 1));
  const double half_difference = 0.5 * (square(0, 0) - square(1, 1));
  const double away = elementary::hypot(half_difference, square(0, 1));
  const double angle = 0.5 * elementary::atan2(square(0, 1), half_difference);
  const double major = std::sqrt(mean + away);
  const double minor = std::sqrt(std::max(0.0, mean - away));
  return {major * (elementary::cos(angle) * first + elementary::sin(angle) * second),
          major > 0.0 ? minor / major : 0.0};
}

/// The measured ellipse turned with the drag, its axes times `scale`.
maps::SurfaceEllipse turnedWithDrag(const deform::Contact& contact, double stretch, double scale) noexcept {
  const Vec3 normal = contact.normal.normalized();
  const Vec3 major = contact.tangential_region.half_major;
  const double length = major.norm();
  Vec3 first = major - major.dot(normal) * normal;
  if (!(first.norm() > 1e-6 * length)) return contact.tangential_region;
  first.normalize();
  const Vec3 second = normal.cross(first);
  const auto flat = [&](const Vec3& v) { return Vec2(first.dot(v), second.dot(v)); };
  const Vec2 measured_along = flat(Vec3::UnitY());
  const Vec2 drag = flat(contact.drag_mm);
  Mat2 shape = Mat2::Identity() * (length * scale);
  shape(1, 1) *= contact.tangential_region.aspect;
  if (measured_along.norm() > 0.1 && drag.norm() > kShortestDragMm) {
    shape = stretched(drag.normalized(), stretch) * stretched(measured_along.normalized(), 1.0 / stretch) * shape;
  }
  return ellipseOf(shape, first, second);
}

std::vector<tissue::LayeredNode> solvedNodes(const Scene& scene) {
  const std::filesystem::path& file = scene.tissue.layer_table;
  if (file.empty()) {
    std::vector<tissue::LayeredNode> nodes = tissue::libraryNodes(fatOf(scene));
    for (tissue::LayeredNode& node : nodes) node = tissue::softenedTo(tissue::kStiffestTissue, std::move(node));
    return nodes;
  }
  const tissue::LayeredTable table = tissue::readLayeredTable(file);
  try {
    return {tissue::nodeOf(table)};
  } catch (const Error& error) {
    throw Error::inFile(file.string(), error.what());
  }
}

std::vector<tissue::LayeredNode> makeLayeredNodes(const Scene& scene) {
  std::vector<tissue::LayeredNode> nodes = solvedNodes(scene);
  if (scene.tissue.by_finger_radius) return nodes;
  for (tissue::LayeredNode& node : nodes) node.fingers.clear();
  return nodes;
}

/// The region of a drag where none was measured: that of the layers themselves, along the drag.
maps::SurfaceEllipse solvedRegion(const deform::Contact& contact, const tissue::DragCurve& drag) noexcept {
  const Vec3 normal = contact.normal.normalized();
  const Vec3 along = contact.drag_mm - contact.drag_mm.dot(normal) * normal;
  if (!(along.norm() > kShortestDragMm)) return {};
  return {drag.along_mm * along.normalized(), drag.across_mm / drag.along_mm};
}

maps::SurfaceEllipse scaled(maps::SurfaceEllipse ellipse, double factor) noexcept {
  ellipse.half_major *= factor;
  return ellipse;
}

bool isMeasured(const Scene& scene) noexcept {
  return scene.body.kind != BodyKind::mesh || !scene.ellipses.key_points.empty();
}

/// Measured on this very person: the ellipse has seen the bones and folds of the place already.
bool isOwn(const Scene& scene) noexcept { return !scene.ellipses.key_points.empty(); }

/// A drag that reaches far: (1 - q^2)^2, of which a tenth is left at 0.83 of the way to the rim. Made once, at load.
const tissue::LayeredCurve& farReachingDrag() {
  static const tissue::LayeredCurve curve = [] {
    std::array<tissue::CurveSample, 64> samples;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double q = static_cast<double>(i) / static_cast<double>(samples.size());
      samples[i] = {q, (1.0 - q * q) * (1.0 - q * q), 1.0};
    }
    return tissue::fittedShare(samples, tissue::kDragBend);
  }();
  return curve;
}

/// Where the farthest rim is too near for a measured ellipse, the drag falls off more slowly on the way: so far that a
/// tenth is left at `tenth_q`, where it was measured.
void widenToTenth(double tenth_q, tissue::LayeredCurve& share) noexcept {
  const tissue::LayeredCurve& far = farReachingDrag();
  const double q2 = tenth_q * tenth_q;
  const double near = tissue::curveAt(share, tissue::kDragBend, q2).value;
  const double wide = tissue::curveAt(far, tissue::kDragBend, q2).value;
  if (near < 0.1 && wide > near) share = tissue::blended(share, far, std::min(1.0, (0.1 - near) / (wide - near)));
}

/// Anatomy may only shorten a region measured on other people; one measured on this person stays as it is.
DirectedFactors dragFactors(const Scene& scene, const PlaceReach& place) noexcept {
  if (isOwn(scene)) return {};
  DirectedFactors factors = place.drag;
  if (!isMeasured(scene)) return factors;
  for (double& factor : factors) factor = std::min(factor, 0.0);
  return factors;
}

/// A contour that was measured is where a tenth of the drag was left, as a measured ellipse is: its rim lies beyond.
void scaleContour(maps::SurfaceContour& contour, double factor) noexcept {
  const double log_farthest = elementary::log(kFarthestRimMm);
  for (std::size_t i = 0; i < contour.contour.count; ++i) {
    double& radius = contour.contour.log_radii[i];
    radius = std::min(radius + elementary::log(factor), log_farthest);
  }
}

/// The drag's region in the shape "contour": the measured contour, or without a table the flat ellipse, lengthened or
/// shortened to each side by the anatomy there.
maps::SurfaceContour contourOfPlace(const World& world, const deform::Contact& contact,
                                    const PlaceReach& place) noexcept {
  const DirectedFactors factors = dragFactors(world.scene, place);
  return world.contours ? bentContour(contact.tangential_contour, factors, place)
                        : bentContour(contact.tangential_region, factors, place);
}

/// The regions of flat skin over even tissue become those of the place. `tenth_q`: where a tenth of the drag is left.
void followAnatomy(const World& world, double tenth_q, deform::Contact& contact) noexcept {
  ReachRequest request{.press = &contact.layered->press};
  const bool drags = contact.drag_mm.norm() > kShortestDragMm;
  if (drags) {
    request.drag_tenth = scaled(contact.tangential_region, tenth_q);
    request.drag = contact.drag_mm;
  }
  const Vec3 normal = contact.normal.normalized();
  const PlaceReach place =
      world.reach->at(world.surface.geometry->tree, contact.anchor_triangle, contact.anchor, normal, request);
  contact.depth_mm = std::min(contact.depth_mm, place.deepest_mm);
  contact.normal_region = bentEllipse(contact.normal_region, place.press, place);
  if (!drags) return;
  if (world.deformation.shape == deform::Shape::contour) {
    contact.tangential_contour = contourOfPlace(world, contact, place);
  } else {
    contact.tangential_region = bentEllipse(contact.tangential_region, dragFactors(world.scene, place), place);
  }
}

}  // namespace

double fatOf(const Scene& scene) {
  if (scene.tissue.fat_mm > 0.0) return scene.tissue.fat_mm;
  constexpr double kMassIndex = 22.0;
  constexpr double kFatMm = 8.0;
  constexpr double kFatPerIndex = 0.93;
  const double index = scene.body.kind == BodyKind::trunk ? scene.body.shape.body_mass_index : kMassIndex;
  return std::clamp(kFatMm + kFatPerIndex * (index - kMassIndex), 2.0, 25.0);
}

PlacedTissue placedTissue(const Scene& scene, const std::vector<double>& bone_depth_mm,
                          std::shared_ptr<const tissue::LayeredTissue> given) {
  static_cast<void>(farReachingDrag());  // not while a finger waits
  PlacedTissue placed;
  placed.layered = given ? std::move(given) : std::make_shared<const tissue::LayeredTissue>(makeLayeredNodes(scene));
  placed.thickness_mm.reserve(bone_depth_mm.size());
  for (const double depth : bone_depth_mm) {
    const double usual = std::isfinite(depth) ? depth : placed.layered->thickest();
    placed.thickness_mm.push_back(std::clamp(usual, placed.layered->thinnest(), placed.layered->thickest()));
  }
  placed.felt_mm = placed.thickness_mm;
  return placed;
}

std::vector<double> secantStiffness(const PlacedTissue& tissue) {
  std::vector<double> stiffness;
  stiffness.reserve(tissue.felt_mm.size());
  for (const double thickness : tissue.felt_mm) {
    stiffness.push_back(tissue.layered->secantAt(thickness, tissue::kReferenceDepthMm));
  }
  return stiffness;
}

deform::Contact layeredContact(const World& world, deform::Contact contact) noexcept {
  const tissue::LayeredTissue& layered = *world.layered;
  const double thickness = thicknessAt(world, contact);
  contact.depth_mm = std::min(contact.depth_mm, layered.deepestAt(thickness));
  const tissue::DragCurve drag = layered.dragAt(thickness);
  contact.layered.emplace(deform::LayeredShape{layered.pressAt(thickness, contact.depth_mm), drag.share});
  contact.normal_region = maps::liftedOntoSurface({contact.layered->press.radius_mm, 1.0}, contact.normal);
  const double stretch = std::sqrt(drag.along_mm / drag.across_mm);
  const double rim_of_tenth = 1.0 / std::max(0.3, drag.tenth_q);
  contact.tangential_region =
      isMeasured(world.scene) ? turnedWithDrag(contact, stretch, rim_of_tenth) : solvedRegion(contact, drag);
  if (world.contours) scaleContour(contact.tangential_contour, rim_of_tenth);
  double tenth_q = drag.tenth_q;
  const double rim = contact.tangential_region.half_major.norm();
  if (rim > kFarthestRimMm) {
    contact.tangential_region.half_major *= kFarthestRimMm / rim;
    if (isOwn(world.scene)) {
      tenth_q *= rim / kFarthestRimMm;
      widenToTenth(tenth_q, contact.layered->drag);
    }
  }
  if (world.reach) followAnatomy(world, tenth_q, contact);
  return contact;
}

std::shared_ptr<const AnatomicalReach> reachOf(const Scene& scene, const mesh::TriangleMesh& skin,
                                               const Anatomy& anatomy, const tree::TriangleTree& tree,
                                               const tissue::LayeredTissue* layered) {
  const DeformationSettings& wanted = scene.deformation;
  const bool contours = wanted.forms.shape == deform::Shape::contour && wanted.contours.empty();
  if (layered == nullptr && !contours) return nullptr;
  if (layered != nullptr)
    return std::make_shared<const AnatomicalReach>(skin, tree, anatomy.depth_mm, anatomy.bones, *layered);
  const tissue::LayeredTissue library(tissue::libraryNodes(fatOf(scene)));
  return std::make_shared<const AnatomicalReach>(skin, tree, anatomy.depth_mm, anatomy.bones, library);
}

maps::SurfaceContour anatomicalContour(const World& world, const deform::Contact& contact) noexcept {
  const ReachRequest request{nullptr, scaled(contact.tangential_region, 1.0 / deform::kTwoMmBoundary), contact.drag_mm};
  const Vec3 normal = contact.normal.normalized();
  const PlaceReach place =
      world.reach->at(world.surface.geometry->tree, contact.anchor_triangle, contact.anchor, normal, request);
  return bentContour(contact.tangential_region, dragFactors(world.scene, place), place);
}

}  // namespace palpate::scene
