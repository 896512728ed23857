// `palpate study profile`: how large the array of the half Gaussian must be, and how it must be read (Figure 4.9).
#pragma once

#include "study/study_page.h"

namespace palpate::study {

StudyPage studyProfile(const StudySettings& settings);

}  // namespace palpate::study
