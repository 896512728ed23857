// A scene's settings for the deformation: the forms, and the files that some of them come from.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "palpate/deform/forms.h"
#include "palpate/maps/contour_map.h"

namespace palpate::scene {

/// Model of the tissue over the bones.
enum class TissueModel : std::uint8_t {
  layered,   ///< skin, fat and muscle, as thick as they are at the place: solved by finite elements
  gaussian,  ///< the dissertation's half Gaussian in regions of one size (E21)
  literal,   ///< the same with the printed rim and one region for press and drag (E18, E21)
};

struct DeformationSettings {
  TissueModel tissue = TissueModel::layered;
  deform::FormSettings forms;  ///< the knots of user profiles are read when the scene is built
  std::filesystem::path profile_file;
  std::filesystem::path tangential_profile_file;
  std::filesystem::path contours;  ///< for shape "contour"; empty: by the anatomy
};

/// A place whose skin follows a curve of its own (place_curves.h).
struct PlaceProfile {
  double x_mm = 0.0;
  double y_mm = 0.0;
  double radius_mm = 40.0;     ///< outside nothing changes
  double edge_softness = 0.5;  ///< share of the radius over which the curve goes over into that around the place
  tissue::ProfileKind press = tissue::ProfileKind::half_gaussian;
  std::filesystem::path press_file = {};  ///< of the kind "user"
  tissue::ProfileKind drag = tissue::ProfileKind::half_gaussian;
  std::filesystem::path drag_file = {};
  double region = 1.0;  ///< factor on the regions of press and drag
  std::string at = {};  ///< the centre in words, before x and y
};

struct Scene;

/// The forms of a scene, complete: its files read, its fidelity and kind of strain filled in. Throws Error.
deform::FormSettings formsOf(const Scene& scene);

/// The measured contours of a scene that names a table of them, for shape "contour". Throws Error for a file that is
/// none.
std::optional<maps::PolarContourMap> contoursOf(const Scene& scene, const maps::EllipseMapSettings& settings);

}  // namespace palpate::scene
