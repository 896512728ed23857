// The studies of other products, for all tests here that ask for every study: offered before the first test, as the
// command does.
#include "measure/study/measuring_study.h"
#include "teach/study/training_study.h"

namespace palpate::study {

namespace {

[[maybe_unused]] const bool kOffered = [] {
  offerStudy(measuringStudy());
  offerStudy(trainingStudy());
  return true;
}();

}  // namespace

}  // namespace palpate::study
