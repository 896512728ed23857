#include "study/studies.h"

#include <fmt/format.h>

#include <chrono>

namespace palpate::study {

const std::vector<Study>& studies() {
  static const std::vector<Study> kStudies{};
  return kStudies;
}

StudyPage runStudy(const Study& study, const StudySettings& settings) {
  const auto start = std::chrono::steady_clock::now();
  StudyPage page = study.run(settings);
  page.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  page.name = study.name;
  page.command = fmt::format("palpate study {}{} --out DIR", study.name, settings.quick ? " --quick" : "");
  return page;
}

}  // namespace palpate::study
