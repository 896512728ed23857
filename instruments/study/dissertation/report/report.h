// `palpate study all`: runs every chapter, writes its page, and binds all into report.html.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "dissertation/errata/errata_study.h"
#include "dissertation/figures/dissertation_figures.h"
#include "dissertation/numbers/number_row.h"
#include "dissertation/studies.h"
#include "palpate/scene/scene.h"

namespace palpate::study {

/// The chapters in order: the studies of numbers, figures and errata, which have commands of their own, as pages like
/// all others, and the pages of studies.h behind them. The errata are measured on this scene.
std::vector<Study> reportChapters(const scene::Scene& scene);

/// A chapter that is done, for a line of progress.
struct ChapterDone {
  std::size_t number = 0;  ///< from 1
  std::size_t of = 0;
  std::string name;
  double seconds = 0.0;  ///< it took, with drawing
};

/// Runs the chapters one after the other (times would suffer from each other side by side) and writes everything into
/// the folder, which is made when missing. The progress names the step, the elapsed time and the present work.
/// After a stop request (stop, checked between chapters; the progress may throw within one), the report binds the
/// chapters that are done and says so. Returns the pages. Throws Error naming a file that cannot be written.
std::vector<StudyPage> writeReport(const std::vector<Study>& chapters, const StudySettings& settings,
                                   const std::filesystem::path& folder,
                                   const std::function<void(const ChapterDone&)>& done = {},
                                   const std::function<bool()>& stop = {});

// Findings of the chapters on numbers, figures and errata: sentences made of nothing but the arguments.

/// How many come out of what, and every number that does not.
std::vector<std::string> numbersFindings(const std::vector<NumberRow>& rows);

/// How many are computed, plotted again, or drawn for an example of our own.
std::vector<std::string> figuresFindings(const std::vector<DissertationFigure>& figures);

/// Effect of all printed forms together under each set of options, the largest one, and those without effect.
std::vector<std::string> errataFindings(const ErrataEffects& effects);

}  // namespace palpate::study
