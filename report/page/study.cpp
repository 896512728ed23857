#include "report/page/study.h"

#include <algorithm>
#include <utility>

namespace palpate::study {

namespace {

// Inside a function, so that it is there whichever file is initialised first.
std::vector<Study>& offered() {
  static std::vector<Study> all;
  return all;
}

}  // namespace

void offerStudy(Study study) {
  std::vector<Study>& all = offered();
  const bool known = std::any_of(all.begin(), all.end(), [&](const Study& other) { return other.name == study.name; });
  if (!known) all.push_back(std::move(study));
}

const std::vector<Study>& offeredStudies() { return offered(); }

}  // namespace palpate::study
