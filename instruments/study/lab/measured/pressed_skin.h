// A finger that presses and drags the built-in back, for the pictures of chapter 4.
#pragma once

#include <vector>

#include "palpate/base/skin_place.h"
#include "palpate/deform/forms.h"
#include "palpate/deform/surface.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::study {

/// The place there on the triangle nearest to a viewer who looks along -z. Throws Error where the surface is not.
SkinPlace placeOn(const mesh::TriangleMesh& mesh, const Vec2& at);

struct Press {
  Vec2 at = Vec2::Zero();
  double depth_mm = 0.0;
  Vec2 drag_mm = Vec2::Zero();          ///< as seen along z; laid into the tangent plane
  double half_major_mm = 60.0;          ///< region of the drag
  double aspect = 1.0;                  ///< minor/major
  double direction_rad = 1.5707963268;  ///< its major axis
};

deform::Contact contactOf(const mesh::TriangleMesh& mesh, const Press& press, const deform::FormSettings& forms);

/// A finger of the engine that comes down `depth_mm` and then moves by `stroke_mm`, in steps of a tick at 0.2 m/s.
struct FeltStroke {
  Vec2 at = Vec2::Zero();
  double depth_mm = 10.0;
  Vec2 stroke_mm = Vec2::Zero();
  double stiffness_ratio = 1.0;  ///< factor of the tangential spring; 0.23 reaches (4.17)'s 20 mm at 10 mm depth (E2)
};

/// The deformation's input from that finger at the end of its way: anchor, depth and drag as friction gives them, the
/// ellipse of the dissertation's map at the anchor.
deform::Contact feltContact(const mesh::TriangleMesh& mesh, const FeltStroke& stroke,
                            const deform::FormSettings& forms = {});

struct PressedSkin {
  std::vector<Vec3> positions;
  std::vector<double> strain;  ///< (4.20), one per vertex
};

PressedSkin pressed(const mesh::TriangleMesh& mesh, const Press& press, const deform::FormSettings& forms = {});

PressedSkin pressed(const mesh::TriangleMesh& mesh, const deform::Contact& contact,
                    const deform::FormSettings& forms = {});

/// Where the plane y = `y` cuts the surface: x and z of the cut, sorted by x.
std::vector<Vec2> crossSection(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles, double y);

}  // namespace palpate::study
