// `palpate study threshold`: how many triangles a leaf should hold (3.3.1).
#pragma once

#include "study/study_page.h"

namespace palpate::study {

StudyPage studyThreshold(const StudySettings& settings);

}  // namespace palpate::study
