// The studies, one page per study: their names, and how they are run.
#pragma once

#include <vector>

#include "report/page/study_page.h"

namespace palpate::study {

/// The dissertation's and, behind them, those of measuring and training where these are built; in the order of a
/// report.
const std::vector<Study>& studies();

/// Runs it and completes the page: name, command (where it names none), machine, seconds.
StudyPage runStudy(const Study& study, const StudySettings& settings);

/// `palpate study assignment`: what becomes of triangles that a splitting plane crosses, cases A, B and C (3.3.2).
StudyPage studyAssignment(const StudySettings& settings);
/// `palpate study complexity`: the worst case w of Tables 3.3 and 3.4 and what searches really visit.
StudyPage studyComplexity(const StudySettings& settings);
/// `palpate study directions`: directions of ellipses averaged as numbers and as tensors (E29, E30).
StudyPage studyDirections(const StudySettings& settings);
/// `palpate study hdb`: how large the haptic detecting box must be (3.3.3, E12).
StudyPage studyHdb(const StudySettings& settings);
/// `palpate study interpolation`: Gaussian radial interpolation (Figures 5.9 to 5.11), its width, and how it foresees
/// what was not measured.
StudyPage studyInterpolation(const StudySettings& settings);
/// `palpate study profile`: how large the array of the half Gaussian must be, and how it must be read (Figure 4.9).
StudyPage studyProfile(const StudySettings& settings);
/// `palpate study relaxation`: skin that gives way in time: force of a press that is held, work, dent, friction.
StudyPage studyRelaxation(const StudySettings& settings);
/// `palpate study rivals`: Table 4.1's other ways to deform on the same press of the same body, against a finer truth.
StudyPage studyRivals(const StudySettings& settings);
/// `palpate study search`: the octree as a search for the touch point and for vertices that move (objective 2).
StudyPage studySearch(const StudySettings& settings);
/// `palpate study stability`: the servo's loop closed over simulated hands, with and without its controller.
StudyPage studyStability(const StudySettings& settings);
/// `palpate study tables`: Tables 3.1, 3.2 and Appendix B on this machine, in the dissertation's way and in ours.
StudyPage studyTables(const StudySettings& settings);
/// `palpate study threshold`: how many triangles a leaf should hold (3.3.1).
StudyPage studyThreshold(const StudySettings& settings);

}  // namespace palpate::study
