// A study that writes a page: its name, its help and how it is run.
//
// dissertation/studies.cpp lists them; `palpate study NAME`, `study all` and the report find them there.
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

}  // namespace palpate::study
