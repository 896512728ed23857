// The parts of measureTraining (training_measurement.h), each filling in its own members.
#pragma once

#include "teach/study/training_measurement.h"

namespace palpate::study {

/// Cells whose runs must not be those of another: the part's number times a thousand, and more.
enum class TrainingPart : std::uint64_t {
  recovery = 1,
  robust,
  stop_rules,
  two_intervals,
  exploration,
  exam,
  power,
  learning,
  changes,
  example,
  groups
};
std::uint64_t cellNumber(TrainingPart part, std::size_t cell);

void measureRecovery(TrainingMeasurement& found, const Progress& progress);
void measureRobustness(TrainingMeasurement& found, const Progress& progress);
void measureStopRules(TrainingMeasurement& found, const Progress& progress);
void measureTwoIntervals(TrainingMeasurement& found, const Progress& progress);
void measureLeftOut(TrainingMeasurement& found, const Progress& progress);
void measureExam(TrainingMeasurement& found, const Progress& progress);

// Measurements of people (training_people.cpp).
void measurePower(TrainingMeasurement& found, const Progress& progress);
void measureLearning(TrainingMeasurement& found, const Progress& progress);
void measureChanges(TrainingMeasurement& found, const Progress& progress);
void measureExample(TrainingMeasurement& found, const Progress& progress);

/// `some` / `all`, for whole numbers of runs.
double computeShare(std::size_t some, std::size_t all);

}  // namespace palpate::study
