// The rivals of Table 4.1 and FSMD on the same presses of the same body: how near to the truth, how long, how much
// memory.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dissertation/rivals/layered_truth.h"
#include "dissertation/rivals/tissue_block.h"
#include "palpate/base/progress.h"

namespace palpate::study {

enum class Rival {
  fsmd,          ///< ours: the circle of the press, R0 + c depth (E21)
  fsmd_printed,  ///< chapter 5: one measured ellipse for press and drag
  free_form,
  mass_spring,
  elements,          ///< linear finite elements, factorised once
  elements_answers,  ///< the same with the answers of the whole skin computed beforehand
};
inline constexpr std::array kRivals{Rival::fsmd,        Rival::fsmd_printed, Rival::free_form,
                                    Rival::mass_spring, Rival::elements,     Rival::elements_answers};

const char* nameOf(Rival rival);
const char* keyOf(Rival rival);  ///< key of its numbers: "free_form"

struct RivalsPlan {
  double side_mm = 120.0;
  std::vector<int> cells;        ///< along a side; the skin of "back_mid"
  int common_cells = 20;         ///< one of them, for every tissue
  std::vector<double> lattices;  ///< spacings of free form, mm
  double lattice_mm = 10.0;      ///< one of them: of free form where one has to be chosen
  int runs = 20;
};
RivalsPlan rivalsPlan(bool quick);

struct RivalRow {
  Rival rival = Rival::fsmd;
  LayeredPress truth;
  int cells = 0;
  std::size_t vertices = 0;         ///< vertices of the skin
  double lattice_mm = 0.0;          ///< spacing of free form
  double normal_error = 0.0;        ///< root mean square within 40 mm of the ball, as a share of the depth
  double error = 0.0;               ///< the same with the motion along the skin
  std::optional<double> force_n{};  ///< FSMD and free form have none
  double once_ms = 0.0;             ///< before the first press
  double press_us = 0.0;
  double bytes = 0.0;
  std::vector<Vec3> rest{};  ///< skin at rest
  std::vector<Vec3> displacements{};
};

struct RivalsMeasurement {
  RivalsPlan plan;
  std::vector<RivalRow> rows;
};
RivalsMeasurement measureRivals(const RivalsPlan& plan, const Progress& progress);

/// Throws Error if it was not measured. Free form: with the plan's lattice.
const RivalRow& findRivalRow(const RivalsMeasurement& found, Rival rival, const std::string& tissue, double depth_mm,
                             int cells);

}  // namespace palpate::study
