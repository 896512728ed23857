#include "dissertation/studies.h"

#include <fmt/format.h>

#include "lab/counters/machine.h"
#include "palpate/base/stopwatch.h"
#ifdef PALPATE_HAS_MEASURE
#include "measure/study/measuring_study.h"
#endif
#ifdef PALPATE_HAS_TEACH
#include "teach/study/lump_measurement.h"
#include "teach/study/training_measurement.h"
#endif

namespace palpate::study {

namespace {

/// The dissertation's, then those of the products that are built.
std::vector<Study> builtStudies() {
  std::vector<Study> all = {
      {"tables", "Tables 3.1, 3.2, Appendix B: drawing, untouched, touched against triangles rendered", studyTables},
      {"hdb", "Size of the haptic detecting box: triangles, time, and when a fast finger gets through", studyHdb},
      {"assignment", "Triangles that a plane crosses, cases A, B, C: count, overlap, misses, time", studyAssignment},
      {"threshold", "How many triangles a leaf should hold, for five sizes of model", studyThreshold},
      {"profile", "The array of the half Gaussian: sizes 20 to 7000, nearest and linear (Figure 4.9)", studyProfile},
      {"interpolation",
       "Gaussian radial interpolation: its width, and points left out and predicted (Figures 5.9 to 5.11)",
       studyInterpolation},
      {"complexity", "What a search for leaves visits, against w and 0.8 n, 0.4 n (Tables 3.3, 3.4)", studyComplexity},
      {"rivals", "FSMD beside free form, masses and springs, finite elements: error, time, memory (Table 4.1)",
       studyRivals},
      {"search", "The octree as a search for the touch point and for the vertices of a region, beside ours",
       studySearch},
      {"directions", "Directions of ellipses averaged as numbers and as tensors (E29, E30)", studyDirections},
      {"stability",
       "Whether a hand can safely hold the loop: stiffness, rate, delay, hand and device, bare and controlled",
       studyStability, false, true},
      {"relaxation", "Skin that gives way in time: the force of a press that is held, its work, the dent that stays",
       studyRelaxation}};
#ifdef PALPATE_HAS_MEASURE
  all.push_back(measuringStudy());
#endif
#ifdef PALPATE_HAS_TEACH
  all.push_back(trainingStudy());
  all.push_back(lumpStudy());
#endif
  return all;
}

}  // namespace

const std::vector<Study>& studies() {
  static const std::vector<Study> all = builtStudies();
  return all;
}

StudyPage runStudy(const Study& study, const StudySettings& settings) {
  const auto start = Clock::now();
  StudyPage page = study.run(settings);
  page.seconds = secondsSince(start);
  if (page.name.empty()) page.name = study.name;
  page.machine = lab::describeMachine(lab::thisMachine());
  if (page.command.empty()) {
    page.command = fmt::format("palpate study {}{} --out DIR", study.name, settings.quick ? " --quick" : "");
  }
  return page;
}

}  // namespace palpate::study
