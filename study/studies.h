// The studies that write a page each: their names, and how they are run.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "study/study_page.h"

namespace palpate::study {

struct Study {
  std::string name;  ///< of the subcommand
  std::string what;  ///< its help, one line
  std::function<StudyPage(const StudySettings& settings)> run;
};

/// In the order of a report.
const std::vector<Study>& studies();

/// Runs it and completes the page: name, command (where it names none), machine, seconds.
StudyPage runStudy(const Study& study, const StudySettings& settings);

}  // namespace palpate::study
