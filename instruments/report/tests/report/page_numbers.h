// A main result of a page by its name.
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "report/page/study_page.h"

namespace palpate::study {

inline double numberOf(const StudyPage& page, const std::string& name) {
  for (const auto& [known, value] : page.numbers) {
    if (known == name) return value;
  }
  ADD_FAILURE() << "no number " << name;
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace palpate::study
