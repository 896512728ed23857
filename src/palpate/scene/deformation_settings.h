// What a scene says about the deformation: the forms, and the files that some of them come from.
#pragma once

#include <filesystem>
#include <optional>
#include <span>

#include "palpate/deform/forms.h"
#include "palpate/maps/contour_map.h"

namespace palpate::scene {

struct DeformationSettings {
  deform::FormSettings forms;  ///< the knots of user profiles are read when the scene is built
  std::filesystem::path profile_file;
  std::filesystem::path tangential_profile_file;
  std::filesystem::path contours;  ///< for shape "contour"; empty: the key ellipses as contours
};

struct Scene;

/// The forms of a scene, complete: its files read, its fidelity and kind of strain filled in. Throws Error.
deform::FormSettings formsOf(const Scene& scene);

/// The contour map of a scene with shape "contour", nothing for the others. Throws Error for a file that is none.
std::optional<maps::PolarContourMap> contoursOf(const Scene& scene, std::span<const maps::KeyPoint> keys,
                                                const maps::EllipseMapSettings& settings);

}  // namespace palpate::scene
