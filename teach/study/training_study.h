// `palpate study training`: whether tests of palpation give back the thresholds of simulated trainees.
#pragma once

#include "report/page/study.h"

namespace palpate::study {

Study trainingStudy();

}  // namespace palpate::study
