// A measured curve as a fit takes it: rows by depth, how much each counts, and how a fit is scored.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "palpate/tissue/fitting/force_curves.h"
#include "palpate/tissue/force_law.h"

namespace palpate::tissue {

/// Different depths below the skin that a fit needs.
inline constexpr std::size_t kMinForceDepths = 4;

/// Rows by depth.
struct ForceRows {
  Eigen::ArrayXd depth_mm;
  Eigen::ArrayXd force_n;
  double most_n = 0.0;  ///< the largest force
};

/// Throws Error, which names the curve, for too few depths below the skin or no force above 0.
ForceRows rowsOf(const ForceCurve& curve);

ForceRows partOf(const ForceRows& rows, const std::vector<Eigen::Index>& which);

/// 1 / max(F, 0.3 F_max): weights of deviations, so that a light touch counts and its noise does not rule.
Eigen::ArrayXd scoreWeights(const ForceRows& rows);

/// RMS of the deviations with these weights, a fraction.
double scoreRms(const ForceRows& rows, const Eigen::ArrayXd& force_n);

/// The k that fits best for effective depths; forces push, so not below 0.
double bestSecant(const Eigen::ArrayXd& effective_mm, const ForceRows& rows, const Eigen::ArrayXd& weights);

/// Fits the rows of these numbers and predicts the forces at these depths.
using Predict = std::function<Eigen::ArrayXd(const std::vector<Eigen::Index>& seen, const Eigen::ArrayXd& depth_mm)>;

/// scoreRms of rows that the fit did not see: a fifth at a time, by turns.
double unseenRms(const ForceRows& rows, const Predict& predict);

// Measured rows as a force table: averaged where they lie close, and never falling.

/// Rows below the skin as at most `most_rows` rows of a table; throws Error where no force is above 0.
ForceTable smoothedTable(const ForceRows& rows, const Eigen::ArrayXd& weights, std::size_t most_rows = 24);

/// N, by the rows: straight between them, from the origin, on with the last slope. Without the law's scaling.
double forceIn(const ForceTable& table, double depth_mm);

/// The text that user_profile.h reads.
std::string forceTableText(const ForceTable& table);

}  // namespace palpate::tissue
