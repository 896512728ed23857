// `palpate study assignment`: what becomes of triangles that a splitting plane crosses, cases A, B and C (3.3.2).
#pragma once

#include "study/study_page.h"

namespace palpate::study {

StudyPage studyAssignment(const StudySettings& settings);

}  // namespace palpate::study
