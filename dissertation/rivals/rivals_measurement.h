// The rivals of Table 4.1 and FSMD on the same presses of the same body: how near to the truth, how long, how much
// memory.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dissertation/rivals/tissue_block.h"
#include "palpate/base/progress.h"
#include "report/page/study_page.h"

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
const char* keyOf(Rival rival);  ///< of numbers: "free_form"

struct RivalsPlan {
  double side_mm = 120.0;
  std::vector<int> cells;        ///< along a side; the skin of "back_mid"
  int common_cells = 20;         ///< one of them, for every tissue
  std::vector<double> lattices;  ///< of free form, mm
  double lattice_mm = 10.0;      ///< one of them: of free form where one has to be chosen
  int runs = 20;
};
RivalsPlan rivalsPlan(bool quick);

struct RivalRow {
  Rival rival = Rival::fsmd;
  LayeredPress truth;
  int cells = 0;
  std::size_t vertices = 0;         ///< of the skin
  double lattice_mm = 0.0;          ///< of free form
  double normal_error = 0.0;        ///< root mean square within 40 mm of the ball, as a share of the depth
  double error = 0.0;               ///< the same with the motion along the skin
  std::optional<double> force_n{};  ///< FSMD and free form have none
  double once_ms = 0.0;             ///< before the first press
  double press_us = 0.0;
  double bytes = 0.0;
  std::vector<Vec3> rest{};  ///< of the skin
  std::vector<Vec3> displacements{};
};

struct RivalsMeasurement {
  RivalsPlan plan;
  std::vector<RivalRow> rows;
};
RivalsMeasurement measureRivals(const RivalsPlan& plan, const Progress& progress);

/// Throws Error where there is none. Free form: with the plan's lattice.
const RivalRow& rowOf(const RivalsMeasurement& found, Rival rival, const std::string& tissue, double depth_mm,
                      int cells);

// What the rivals' measurement says: sentences made of nothing but its numbers, and the sums that these and the tables
// are made of.

inline constexpr const char* kFittedTissue = "back_mid";  ///< that the default circle of FSMD was fitted to (E21)

/// Of the rows of a method at the common size, every tissue and depth; free form with the plan's lattice.
template <class Function>
void forEachCommon(const RivalsMeasurement& found, Rival rival, const Function& function) {
  for (const LayeredPress& press : layeredPresses()) {
    function(rowOf(found, rival, press.tissue, press.depth_mm, found.plan.common_cells));
  }
}

Extent errorsOf(const RivalsMeasurement& found, Rival rival);
double meanErrorOf(const RivalsMeasurement& found, Rival rival);
double slowestUs(const RivalsMeasurement& found, Rival rival);

/// A paragraph each, most important first.
std::vector<std::string> rivalFindings(const RivalsMeasurement& found);

// The pictures of the study of rivals: sections through the pressed skin, error against time, skins coloured by error.

std::vector<StudyFigure> rivalFigures(const RivalsMeasurement& found);

/// A time as people read it: "2.1 us", "35 ms", "1.2 s".
std::string readableTime(double microseconds);
/// "12 kB", "3.4 MB".
std::string readableBytes(double bytes);

}  // namespace palpate::study
