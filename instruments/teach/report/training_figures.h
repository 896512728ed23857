// The pictures of a training report, each with the words for who cannot see it.
#pragma once

#include <string>
#include <vector>

#include "report/charts/figure.h"
#include "teach/report/training_report.h"

namespace palpate::app {

struct TrainingPicture {
  std::string id;           ///< in the page
  std::string caption;      ///< explains how to read it
  std::string alternative;  ///< describes the figure in words
  figures::Figure figure;
};

/// Thresholds from block to block with 95 % bands, and the class's quartiles behind. Needs a point.
TrainingPicture curvePicture(const training::TraineeStatistics& trainee, const std::vector<training::Occasion>& others);
/// The class from occasion to occasion: all trainees, quartiles, the group with its 95 % interval. Needs an occasion.
TrainingPicture classCurvePicture(const training::TrainingStatistics& statistics);

/// Fitted function and binned answers of the first and the newest of these blocks, which have thresholds.
TrainingPicture fitPicture(const std::vector<const training::ThresholdPoint*>& blocks);
/// All answers of a class against the change in units of each one's threshold.
TrainingPicture collapsedPicture(const std::vector<training::AnswerBox>& boxes);

TrainingPicture accuracyPicture(const training::TrialStatistics& tests, const training::TrialStatistics& practice);
/// Force and speed.
TrainingPicture handlingPicture(const training::TrialStatistics& tests, const training::TrialStatistics& practice);
TrainingPicture secondsPicture(const training::TrialStatistics& tests, const training::TrialStatistics& practice);
TrainingPicture answersPicture(const training::TrialStatistics& trials, const std::string& what);

/// Dwell and peak force of each site on the back.
TrainingPicture coveragePicture(const training::TrialStatistics& trials, const ReportBack& back,
                                const std::string& what);

}  // namespace palpate::app
