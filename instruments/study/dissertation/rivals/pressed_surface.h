// A rival's answer (Table 4.1) to a press of the block of tissue.
#pragma once

#include <vector>

#include "palpate/base/vec.h"

namespace palpate::study {

struct PressedSurface {
  std::vector<Vec3> displacements;  ///< mm, of the vertices of TissueBlock::skin()
  double force_n = 0.0;
};

}  // namespace palpate::study
