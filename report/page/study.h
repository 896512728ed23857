// A study that writes a page: its name, its help and how it is run.
//
// The dissertation's own studies stand in dissertation/studies.cpp. A product that is built apart offers its study
// here, so that neither includes the other: `palpate study NAME`, `study all` and the report find both.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "report/page/study_page.h"

namespace palpate::study {

struct Study {
  std::string name;  ///< of the subcommand
  std::string what;  ///< its help, one line
  std::function<StudyPage(const StudySettings& settings)> run;
  bool draws = false;                   ///< its cases, from a seed: it takes --seed and --cases
  bool maps = false;                    ///< it has a map of its own that takes minutes: it takes --map
  std::vector<std::string> families{};  ///< of cases that it can be asked for alone: it takes --family
  std::size_t family_cases = 0;         ///< cases of a family where --cases is not given
};

/// Adds a study behind those that are there; nothing happens where its name is taken. Call it at the start of a
/// program, on its first thread, before anything asks for the studies.
void offerStudy(Study study);

/// In the order in which they were offered.
const std::vector<Study>& offeredStudies();

}  // namespace palpate::study
