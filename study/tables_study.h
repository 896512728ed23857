// `palpate study tables`: Tables 3.1, 3.2 and Appendix B on this machine, in the dissertation's way and in ours.
#pragma once

#include "study/study_page.h"

namespace palpate::study {

StudyPage studyTables(const StudySettings& settings);

}  // namespace palpate::study
