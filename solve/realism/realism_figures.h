// The figure for realism: a row for each solved press, with the layered, the Gaussian and the literal skin beside it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "palpate/base/progress.h"
#include "solve/realism/realism.h"

namespace palpate::lab {

/// A stack, solved; and the tissue that the product has for it.
struct JudgedStack {
  std::string name;
  FemCases truth = {};
  std::optional<elements::DragField> drag = {};  ///< solved too
  std::shared_ptr<const tissue::LayeredTissue> tissue = nullptr;
  double thickness_mm = 0.0;
};

struct JudgedPress {
  std::string name;
  double depth_mm = 0.0;
  bool layered_stack = false;  ///< more than one modulus
  double true_force_n = 0.0;
  PressError layered;
  PressError gaussian;
  PressError literal;
};

struct JudgedDrag {
  std::string name;
  bool layered_stack = false;
  double layered_rms = 0.0;  ///< fractions of the drag
  double gaussian_rms = 0.0;
};

/// Of layered stacks; presses of at least `from_mm`.
struct WorstErrors {
  double normal_rms = 0.0;
  double vector_rms = 0.0;
  double force_error = 0.0;
};

struct RealismFigures {
  std::vector<JudgedPress> presses;
  std::vector<JudgedDrag> drags;
  std::vector<std::string> left_out;

  WorstErrors worst(PressError JudgedPress::*of, double from_mm) const;
  double worstDrag(double JudgedDrag::*of) const;
};

/// Presses shallower than this are shown and not judged by the shape.
inline constexpr double kJudgedFromMm = 5.0;

RealismFigures judgeRealism(const std::vector<JudgedStack>& stacks, const Progress& progress = {});

}  // namespace palpate::lab
