// A grid of 1 mm is finer than anything that a fingertip makes; its vertices weigh the same, so that means over them
// are means over area.
#include "solve/realism/realism.h"

#include <algorithm>
#include <cmath>

#include "palpate/contact/finger.h"
#include "palpate/engine/living_skin.h"
#include "palpate/scene/body_parts.h"

namespace palpate::lab {

namespace {

constexpr double kHalfWidthMm = 90.0;
constexpr int kCells = 180;
constexpr double kJudgedMm = 40.0;
constexpr double kJudgedDragMm = 60.0;
/// The literal form has one ellipse for press and drag: the largest that was measured, at P2.
constexpr double kLiteralAxisMm = 149.0;

mesh::TriangleMesh flatSkin() {
  mesh::TriangleMesh mesh;
  constexpr Index kRow = kCells + 1;
  for (Index j = 0; j < kRow; ++j) {
    for (Index i = 0; i < kRow; ++i) {
      mesh.positions.emplace_back(2.0 * kHalfWidthMm * i / kCells - kHalfWidthMm,
                                  2.0 * kHalfWidthMm * j / kCells - kHalfWidthMm, 0.0);
    }
  }
  for (Index j = 0; j < kCells; ++j) {
    for (Index i = 0; i < kCells; ++i) {
      const Index a = j * kRow + i;
      mesh.triangles.push_back({a, a + 1, a + kRow + 1});
      mesh.triangles.push_back({a, a + kRow + 1, a + kRow});
    }
  }
  return mesh;
}

Vec3 vertexPosition(const deform::DeformedSurface& surface, Index v) {
  return {surface.position(0)[v], surface.position(1)[v], surface.position(2)[v]};
}

double at(const std::vector<double>& radii, const std::vector<double>& values, double r) {
  if (r <= radii.front()) return values.front();
  if (r >= radii.back()) return values.back();
  const auto above = static_cast<std::size_t>(std::upper_bound(radii.begin(), radii.end(), r) - radii.begin());
  const double share = (r - radii[above - 1]) / (radii[above] - radii[above - 1]);
  return values[above - 1] + share * (values[above] - values[above - 1]);
}

/// A finger that comes down in the middle and stays; radius 0: a point.
contact::FingerOutput pressed(const scene::World& world, double depth_mm, double radius_mm = 0.0) {
  scene::Finger finger;
  finger.radius_mm = radius_mm;
  const contact::FingerSettings settings = scene::contactSettings(world.scene, finger);
  contact::FingerState state;
  contact::FingerOutput output;
  constexpr int kWay = 400;
  constexpr int kRest = 50;
  for (int tick = 0; tick <= kWay + kRest; ++tick) {
    const double share = std::min(1.0, static_cast<double>(tick) / kWay);
    output =
        contact::step(world.surface, settings, state, Vec3(0.0, 0.0, radius_mm + (1.0 - share * (1.0 + depth_mm))));
  }
  return output;
}

ShapeError shapeError(const scene::World& world, const deform::DeformedSurface& surface, const FemCase& truth,
                      const std::vector<double>& radii) {
  const double u0 = truth.truth.surface_mm;
  double normal2 = 0.0;
  double vector2 = 0.0;
  ShapeError error;
  std::size_t count = 0;
  for (Index v = 0; v < world.body->skin.positions.size(); ++v) {
    const Vec3 rest = world.body->skin.positions[v];
    const double r = rest.head<2>().norm();
    if (r > kJudgedMm) continue;
    const Vec3 moved = vertexPosition(surface, v) - rest;
    const Vec3 out = r > 0.0 ? Vec3(rest.x() / r, rest.y() / r, 0.0) : Vec3(Vec3::Zero());
    const double down = (-moved.z() - u0 * at(radii, truth.truth.down, r)) / u0;
    const double outward = (moved.dot(out) - u0 * at(radii, truth.truth.outward, r)) / u0;
    normal2 += down * down;
    vector2 += down * down + outward * outward;
    error.worst = std::max(error.worst, std::abs(down));
    ++count;
  }
  error.normal_rms = std::sqrt(normal2 / static_cast<double>(count));
  error.vector_rms = std::sqrt(vector2 / static_cast<double>(count));
  return error;
}

}  // namespace

std::shared_ptr<const scene::World> flatWorld(scene::TissueModel model,
                                              std::shared_ptr<const tissue::LayeredTissue> tissue, double thickness_mm,
                                              double stiffness_n_per_mm) {
  scene::Scene scene;
  scene.body.kind = scene::BodyKind::mesh;
  scene.deformation.tissue = model;
  scene.stiffness.constant_n_per_mm = stiffness_n_per_mm;
  scene.ellipses.basic_radius_mm = kLiteralAxisMm;
  std::vector<Index> source_vertex;
  scene::BodyParts body = scene::mendedBody(flatSkin(), "slab", {}, source_vertex);
  if (model == scene::TissueModel::layered) {
    body.anatomy.depth_mm.assign(body.skin.positions.size(), thickness_mm);
    body.given_layers = std::move(tissue);
  }
  return scene::buildOn(scene, std::move(body));
}

PressError pressError(const scene::World& world, const FemCase& truth, const std::vector<double>& radii_mm) {
  const contact::FingerOutput felt = pressed(world, truth.truth.depth_mm);
  engine::LivingSkin skin(world);
  skin.follow(std::span(&felt, 1));
  PressError error;
  error.shape = shapeError(world, skin.surface(), truth, radii_mm);
  error.force_n = felt.force.norm();
  error.force_error = (error.force_n - truth.truth.force_n) / truth.truth.force_n;
  return error;
}

double pressedForce(const scene::World& world, double radius_mm, double depth_mm) {
  return pressed(world, depth_mm, radius_mm).force.norm();
}

double dragError(const scene::World& world, const elements::DragField& truth) {
  contact::FingerOutput felt = pressed(world, 1.0);
  felt.depth_mm = 0.0;
  felt.proxy = felt.anchor + Vec3::UnitX();
  engine::LivingSkin skin(world);
  skin.follow(std::span(&felt, 1));
  double sum = 0.0;
  std::size_t count = 0;
  for (Index v = 0; v < world.body->skin.positions.size(); ++v) {
    const Vec3 rest = world.body->skin.positions[v];
    if (std::abs(rest.x()) > kJudgedDragMm || std::abs(rest.y()) > kJudgedDragMm) continue;
    const double moved = vertexPosition(skin.surface(), v).x() - rest.x();
    const double error = moved - truth.at(std::abs(rest.x()), std::abs(rest.y()));
    sum += error * error;
    ++count;
  }
  return std::sqrt(sum / static_cast<double>(count));
}

}  // namespace palpate::lab
