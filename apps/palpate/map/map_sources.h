// From key points to the maps that `palpate map` writes: ellipses, irregular contours, stiffness.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "apps/palpate/map/map_skin.h"
#include "palpate/base/fidelity.h"
#include "palpate/maps/contour_map.h"
#include "palpate/maps/ellipse_map.h"
#include "palpate/maps/literal_ellipse_map.h"
#include "palpate/maps/measured_stiffness.h"

namespace palpate::app {

/// What the subcommands of `map` were told about their source.
struct MapSource {
  std::string key_file;  ///< empty: the dissertation's key points
  maps::MeasuredDataChoice measured;
  maps::EllipseMapSettings ellipses;
  Fidelity fidelity;
  std::optional<maps::LiteralWeights> weights;         ///< nothing: as the fidelity says
  std::optional<maps::DirectionBlend> directions;      ///< nothing: as the fidelity says
  std::string quantity = "half-major";                 ///< of ellipses: half-major, aspect or direction
  std::size_t contour_radii = maps::kMaxContourRadii;  ///< of the contours made from ellipses
  maps::MeasuredStiffness stiffness;
  bool interpolate_depth = false;  ///< stiffness without key file: measure the torso at the seven places
};

SkinMap ellipsesOver(const MapSkin& skin, const MapSource& source);
SkinMap contoursOver(const MapSkin& skin, const MapSource& source);
/// From a key file with a stiffness, or from the depth of the bones of the torso. Throws Error where there is neither.
SkinMap stiffnessOver(const MapSkin& skin, const MapSource& source);

}  // namespace palpate::app
