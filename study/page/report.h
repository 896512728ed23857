// `palpate study all`: runs every chapter, writes its page, and binds all into report.html.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "study/studies.h"

namespace palpate::study {

/// A chapter that is done, for a line of progress.
struct ChapterDone {
  std::size_t number = 0;  ///< from 1
  std::size_t of = 0;
  std::string name;
  double seconds = 0.0;  ///< it took, with drawing
};

/// Runs the chapters one after the other (times would suffer from each other side by side) and writes everything into
/// the folder, which is made when missing. The progress names the step, the elapsed time and what is being done.
/// Returns the pages. Throws Error naming a file that cannot be written.
std::vector<StudyPage> writeReport(const std::vector<Study>& chapters, const StudySettings& settings,
                                   const std::filesystem::path& folder,
                                   const std::function<void(const ChapterDone&)>& done = {});

}  // namespace palpate::study
