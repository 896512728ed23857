// A triangle surface seen from afar, as plain data: flat shaded, with boxes, planes and spheres around it.
//
// Seen in parallel projection, painted from back to front (draw_mesh_view.cpp).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "palpate/base/vec.h"
#include "report/charts/colour.h"
#include "report/charts/plot.h"

namespace palpate::figures {

/// Line segments, two points each.
struct Segments {
  std::string name{};  ///< for the legend; an empty name is not listed
  std::vector<std::array<Vec3, 2>> segments{};
  Colour colour = kInk;
  double width_px = 1.2;
  bool on_top = false;  ///< painted over everything instead of in their depth
};

/// A flat, see-through parallelogram: a splitting plane.
struct Sheet {
  Vec3 corner = Vec3::Zero();
  Vec3 side_u = Vec3::UnitX();
  Vec3 side_v = Vec3::UnitY();
  Colour colour = withAlpha(kGreen, 0.35);
};

struct Ball {
  Vec3 centre = Vec3::Zero();
  double radius = 1.0;
  Colour colour = kVermilion;
};

/// Painted over everything.
using Place3 = PlaceAt<Vec3>;

struct LegendColour {
  std::string name{};
  Colour colour{};
};

/// The key of the triangles' colours, for the colour bar.
struct ColourKey {
  std::string label{};
  std::string unit{};
  double from = 0.0;
  double to = 1.0;
  ColourMap colours = ColourMap::viridis;
};

struct MeshView {
  std::string title{};
  std::vector<Vec3> positions{};
  std::vector<Triangle> triangles{};
  std::vector<Colour> colours{};  ///< one per triangle; `colour` for all where empty
  Colour colour = kSkin;
  bool edges = false;  ///< the triangles' sides as thin lines
  /// Shares of light that does not depend on the direction; 1 shows the plain colours, for maps.
  double ambient = 0.45;
  Vec3 towards_viewer = Vec3::UnitZ();
  Vec3 up = Vec3::UnitY();
  std::vector<Segments> lines{};
  std::vector<Sheet> sheets{};
  std::vector<Ball> balls{};
  std::vector<Place3> places{};
  std::vector<LegendColour> legend{};
  std::optional<ColourKey> colour_key{};
  bool scale_bar = true;  ///< a bar of a round length in mm
};

/// The twelve edges of a box.
std::vector<std::array<Vec3, 2>> boxEdges(const Eigen::AlignedBox3d& box);

}  // namespace palpate::figures
