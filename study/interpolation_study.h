// `palpate study interpolation`: Gaussian radial interpolation (Figures 5.9 to 5.11), its width, and how it foresees
// what was not measured.
#pragma once

#include "study/study_page.h"

namespace palpate::study {

StudyPage studyInterpolation(const StudySettings& settings);

}  // namespace palpate::study
