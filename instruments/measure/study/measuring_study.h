// `palpate study measuring`: key ellipses from synthetic photographs against their truth.
#pragma once

#include "report/page/study_page.h"

namespace palpate::study {

Study measuringStudy();

}  // namespace palpate::study
