// `palpate study hdb`: how large the haptic detecting box must be (3.3.3, E12).
#pragma once

#include "study/study_page.h"

namespace palpate::study {

StudyPage studyHdb(const StudySettings& settings);

}  // namespace palpate::study
