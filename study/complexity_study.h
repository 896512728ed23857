// `palpate study complexity`: the worst case w of Tables 3.3 and 3.4 and what searches really visit.
#pragma once

#include "study/study_page.h"

namespace palpate::study {

StudyPage studyComplexity(const StudySettings& settings);

}  // namespace palpate::study
