// The built-in back as a triangle mesh: the smooth skin cut at its outline, at any density.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "palpate/body/skin_outline.h"
#include "palpate/body/skin_relief.h"
#include "palpate/body/skin_surface.h"
#include "palpate/mesh/triangle_mesh.h"

namespace palpate::body {

/// The shape of the skin, for any density.
struct SkinSettings {
  double stature_mm = 1750;  ///< everything scales with it
  ReliefSettings relief;     ///< how much of the bones shows
  double asymmetry = 0;      ///< 0 symmetric, 1 naturally uneven: sway of the midline, lower right shoulder, muscles
};

struct BackSettings {
  std::size_t triangles = 15815;  ///< exact; 500 to 4,000,000 and beyond
  SkinSettings shape;
};

/// A skin in triangles, with what only the smooth surface knows. Open sheet, one border, normals out of the body.
struct Skin {
  mesh::TriangleMesh mesh;
  std::vector<Vec3> normals;  ///< unit, one per vertex; of the smooth surface
  Index border = 0;           ///< vertices [0, border) go round the outline
};

/// The smooth skin of these settings. Makes bones when relief is wanted (about a second); without, at once. Throws
/// Error on a setting out of range.
SkinSurface makeSkinSurface(const SkinSettings& settings);
/// The same with bones already made: those of a man of 1750 mm, not warped.
SkinSurface makeSkinSurface(const SkinSettings& settings, std::span<const Bone> bones);

/// The part of the skin inside an outline, in exactly `triangles` triangles. Throws Error below 500.
Skin meshSkin(const SkinSurface& surface, SkinExtent extent, std::size_t triangles);

/// The patch of 350 x 400 x 120 mm (at 1750 mm) that shows T1 to L3.
Skin makeBackSkin(const BackSettings& settings = {});
/// The same, the mesh alone.
mesh::TriangleMesh makeBack(const BackSettings& settings = {});

}  // namespace palpate::body
