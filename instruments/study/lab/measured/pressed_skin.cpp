// Presses by the general displacement whatever the forms are: pictures compare forms, not ways.
#include "lab/measured/pressed_skin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "palpate/base/error.h"
#include "palpate/contact/finger.h"
#include "palpate/deform/deformer.h"
#include "palpate/deform/finger_contact.h"
#include "palpate/maps/key_points.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::study {

namespace {

// Barycentric coordinates of a place in a triangle seen along z; not finite for one seen on edge.
Vec3 barycentric(const std::array<Vec3, 3>& corners, const Vec2& at) {
  const Vec2 u = (corners[1] - corners[0]).head<2>();
  const Vec2 v = (corners[2] - corners[0]).head<2>();
  const Vec2 w = at - corners[0].head<2>();
  const double area = u.x() * v.y() - u.y() * v.x();
  const double b = (w.x() * v.y() - w.y() * v.x()) / area;
  const double c = (u.x() * w.y() - u.y() * w.x()) / area;
  return {1.0 - b - c, b, c};
}

std::array<Vec3, 3> cornersOf(const std::vector<Vec3>& positions, const Triangle& triangle) {
  return {positions[triangle[0]], positions[triangle[1]], positions[triangle[2]]};
}

Vec3 inTangentPlane(const Vec2& seen, const Vec3& normal) {
  const Vec3 flat(seen.x(), seen.y(), 0.0);
  const Vec3 tangent = flat - normal.dot(flat) * normal;
  const double length = tangent.norm();
  return length > 0.0 ? Vec3(tangent * (seen.norm() / length)) : Vec3::Zero();
}

}  // namespace

SkinPlace placeOn(const mesh::TriangleMesh& mesh, const Vec2& at) {
  const std::vector<Vec3> normals = mesh::triangleNormals(mesh);
  SkinPlace found;
  for (Index t = 0; t < mesh.triangles.size(); ++t) {
    const auto corners = cornersOf(mesh.positions, mesh.triangles[t]);
    const Vec3 weights = barycentric(corners, at);
    if (!(weights.minCoeff() >= 0.0)) continue;
    const Vec3 position = weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
    if (found.triangle != kNoIndex && position.z() <= found.point.z()) continue;
    found = {position, normals[t], t};
  }
  if (found.triangle == kNoIndex) throw Error(fmt::format("no skin at ({:g}, {:g}) mm", at.x(), at.y()));
  return found;
}

deform::Contact contactOf(const mesh::TriangleMesh& mesh, const Press& press, const deform::FormSettings& forms) {
  const SkinPlace place = placeOn(mesh, press.at);
  deform::Contact contact;
  contact.anchor = place.point;
  contact.anchor_triangle = place.triangle;
  contact.normal = place.normal;
  contact.depth_mm = press.depth_mm;
  contact.drag_mm = inTangentPlane(press.drag_mm, place.normal);
  contact.tangential_region =
      maps::liftedOntoSurface({press.half_major_mm, press.aspect, press.direction_rad}, place.normal);
  contact.normal_region = deform::normalRegion(place.normal, press.depth_mm, forms.common.tissue);
  return deform::formedRegions(contact, forms);
}

deform::Contact feltContact(const mesh::TriangleMesh& mesh, const FeltStroke& stroke,
                            const deform::FormSettings& forms) {
  constexpr double kTickMm = 0.2;
  constexpr double kAboveMm = 2.0;
  const contact::Surface surface = contact::buildSurface(mesh, std::vector<double>(mesh.positions.size(), 0.5));
  const contact::FingerSettings settings{.stiffness_ratio = stroke.stiffness_ratio};
  const SkinPlace start = placeOn(mesh, stroke.at);
  const Vec3 down = start.point - stroke.depth_mm * start.normal;
  const Vec3 along = inTangentPlane(stroke.stroke_mm, start.normal);
  contact::FingerState state{};
  contact::FingerOutput felt{};
  const auto walk = [&](const Vec3& from, const Vec3& to) {
    const int ticks = static_cast<int>(std::ceil((to - from).norm() / kTickMm));
    for (int tick = 0; tick <= ticks; ++tick) {
      felt = contact::step(surface, settings, state, from + (to - from) * (ticks > 0 ? 1.0 * tick / ticks : 0.0));
    }
  };
  walk(start.point + kAboveMm * start.normal, down);
  walk(down, down + along);
  static const maps::EllipseMap map(maps::dissertationKeyPoints());
  const auto contact = deform::contactOf(felt, map, forms.common.tissue);
  if (!contact) throw Error("study: the finger does not touch the skin");
  return deform::formedRegions(*contact, forms);
}

PressedSkin pressed(const mesh::TriangleMesh& mesh, const Press& press, const deform::FormSettings& forms) {
  return pressed(mesh, contactOf(mesh, press, forms), forms);
}

PressedSkin pressed(const mesh::TriangleMesh& mesh, const deform::Contact& contact, const deform::FormSettings& forms) {
  const deform::Skin skin = deform::buildSkin(mesh);
  deform::Deformer deformer(skin, forms, deform::Way::general);
  deform::DeformedSurface surface(skin);
  deformer.apply({&contact, 1}, surface);
  PressedSkin result;
  for (Index v = 0; v < surface.vertices(); ++v) result.positions.push_back(surface.positionAt(v).cast<double>());
  result.strain.assign(surface.strain().begin(), surface.strain().end());
  return result;
}

std::vector<Vec2> crossSection(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles, double y) {
  std::vector<Vec2> cut;
  for (const Triangle& triangle : triangles) {
    const auto corners = cornersOf(positions, triangle);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& a = corners[i];
      const Vec3& b = corners[(i + 1) % 3];
      if ((a.y() < y) == (b.y() < y)) continue;
      const Vec3 at = a + (y - a.y()) / (b.y() - a.y()) * (b - a);
      cut.emplace_back(at.x(), at.z());
    }
  }
  std::sort(cut.begin(), cut.end(), [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); });
  return cut;
}

}  // namespace palpate::study
