// Force by depth at named places of a body -> how stiff each place is, in three forms, and which predicts best.
//
//   FORCES.csv ─ readPlaceCurves ─► PlaceCurve ─ fitPlaces ─► PlaceStiffness ─► key points with a stiffness, scene keys
//
// Fits and cross-validation are those of tissue/fitting; here presses are gathered by place, people are averaged, and
// rows that cannot be a press are refused with a reason. The stiffness of a place is the secant at 8 mm, which is what
// the stiffness map means under every law (tissue/force_law.h). Docs/howto/measure-a-person.md.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/base/vec.h"
#include "palpate/maps/key_points.h"
#include "palpate/measure/field/skin_field.h"
#include "palpate/tissue/fitting/force_fit.h"

namespace palpate::measure {

/// One press at one place.
struct PlaceCurve {
  std::string place;
  std::optional<Vec2> at_mm = {};
  std::string subject = {};
  tissue::ForceCurve curve = {};
};

/// A header names the columns: place (or name, point), depth_mm, force_n and where known x_mm, y_mm, subject, press.
/// Curves in the order in which they first appear. Throws Error with the line, also where one place lies at two.
std::vector<PlaceCurve> readPlaceCurves(const std::filesystem::path& file);
std::vector<PlaceCurve> parsePlaceCurves(std::string_view text, std::string_view file);

inline constexpr std::array kPlaceForms = {tissue::ForceForm::linear, tissue::ForceForm::power,
                                           tissue::ForceForm::stiffening};

/// A form on all rows of a place.
struct FormOfPlace {
  tissue::ForceFit fit;
  double r_squared = 0.0;  ///< share of the forces' variance explained
  double rms_n = 0.0;
};

struct PlaceStiffness {
  std::string place;
  std::optional<Vec2> at_mm = {};
  tissue::ForceCurve rows = {};  ///< rows of all presses
  std::size_t presses = 0;
  std::size_t subjects = 0;
  std::vector<FormOfPlace> forms = {};  ///< in the order of kPlaceForms; none where refused
  std::size_t chosen = 0;               ///< index of the chosen one
  Estimate secant_n_per_mm = {};        ///< at 8 mm, of the chosen form; over people, each a mean over presses
  std::string refusal = {};             ///< reason and remedy; empty: fine
  std::vector<std::string> warnings = {};

  bool refused() const { return !refusal.empty(); }
  const FormOfPlace& best() const { return forms[chosen]; }
};

struct PlaceFitSettings {
  std::optional<tissue::ForceForm> form = {};  ///< empty: the one that predicts unseen rows best
};

struct PlaceFits {
  std::vector<PlaceStiffness> places;
  /// One shape for all places that were not refused; none where all were.
  std::optional<tissue::ForceFit> shared = {};
};

/// Never throws because of the rows' contents: a fault becomes a refusal of the place.
PlaceFits fitPlaces(std::span<const PlaceCurve> curves, const PlaceFitSettings& settings = {},
                    const Progress& progress = {});

/// The places as key points: those of `keys` with the same name get the stiffness, others are added without an ellipse.
/// Throws Error for a place that neither lies anywhere nor is among the keys.
std::vector<maps::KeyPoint> withStiffness(const PlaceFits& fits, std::vector<maps::KeyPoint> keys = {});

/// Key points as a table for readKeyPoints; fields of missing ellipses and stiffnesses are empty.
std::string stiffnessTable(std::span<const maps::KeyPoint> keys);

/// Lines of a scene's [tissue] for the shape that the places share; empty without one.
std::string tissueKeys(const PlaceFits& fits);

}  // namespace palpate::measure
