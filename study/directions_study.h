// `palpate study directions`: directions of ellipses averaged as numbers and as tensors (E29, E30).
#pragma once

#include "study/study_page.h"

namespace palpate::study {

StudyPage studyDirections(const StudySettings& settings);

}  // namespace palpate::study
