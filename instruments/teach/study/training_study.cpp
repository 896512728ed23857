// The study of training: whether tests of thresholds give back what simulated trainees have.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/page/plot_parts.h"
#include "teach/study/eye_observer.h"
#include "teach/study/training_measurement.h"
#include "teach/study/training_numbers.h"

namespace palpate::study {

namespace {

std::string percentPoints(double share) { return fmt::format("{:.3g} %", 100.0 * share); }

// ----------------------------------------------------------------------------------------------------------- tables

TextTable trainingBarTable(const TrainingMeasurement& found) {
  TextTable table{{"", "bar", "reached", ""}, {}};
  for (const TrainingBar& bar : trainingBars(found)) {
    table.rows.push_back({bar.what, bar.bar, bar.reached, bar.met ? "met" : "missed"});
  }
  return table;
}

/// Bias / SD / coverage of each truth.
std::vector<std::string> cellTexts(const std::vector<RecoveryCell>& cells) {
  std::vector<std::string> texts;
  for (const RecoveryCell& cell : cells) {
    texts.push_back(fmt::format("{:+.2f} / {:.3f} / {:.3f}", cell.bias_points, cell.sd_ln, cell.coverage));
  }
  return texts;
}

std::vector<std::string> truthHeadings(const std::vector<double>& truths, const std::string& first) {
  std::vector<std::string> headings = {first};
  for (const double truth : truths) headings.push_back("T = " + percentPoints(truth));
  return headings;
}

TextTable methodTable(const TrainingMeasurement& found) {
  TextTable table{truthHeadings(found.truths, "bias (points) / SD of ln T / coverage"), {}};
  table.headings.emplace_back("trials until the error stays below 15 %");
  for (const MethodRow& row : found.methods) {
    std::vector<std::string> cells = {nameOf(row.method)};
    for (const std::string& text : cellTexts(row.cells)) cells.push_back(text);
    const std::string longest = fmt::format("> {}", row.error_ln.size());
    const std::string least = row.least_to_15 > 0 ? fmt::format("{}", row.least_to_15) : longest;
    const std::string most = row.most_to_15 > 0 ? fmt::format("{}", row.most_to_15) : longest;
    cells.push_back(least == most ? least : fmt::format("{} to {}", least, most));
    table.rows.push_back(std::move(cells));
  }
  return table;
}

TextTable readingTable(const TrainingMeasurement& found) {
  TextTable table{
      {"told without a fit, 40 trials", "reads, in T", "SD of ln (largest)", "interval holds its aim", "told in"}, {}};
  for (const ReadingRow& row : found.readings) {
    table.rows.push_back({row.name, fmt::format("{:.2f} to {:.2f}", row.least_ratio, row.most_ratio),
                          fmt::format("{:.2f}", row.sd_ln),
                          row.coverage > 0.0 ? fmt::format("{:.2f}", row.coverage) : "-", percent(row.told)});
  }
  return table;
}

void addCells(TextTable& table, const std::vector<NamedCells>& rows) {
  for (const NamedCells& row : rows) {
    std::vector<std::string> cells = {row.name};
    for (const RecoveryCell& cell : row.cells) {
      cells.push_back(fmt::format("{:+.2f} / {:.3f} / {:.3f} / {:.0f} ({:.0f})", cell.bias_points, cell.sd_ln,
                                  cell.coverage, cell.mean_trials, cell.trials_90));
    }
    table.rows.push_back(std::move(cells));
  }
}

TextTable outsideTable(const TrainingMeasurement& found) {
  TextTable table{
      truthHeadings({0.07, 0.14, 0.28}, "bias (points) / SD of ln T / coverage / trials (nine in ten: no more)"), {}};
  addCells(table, found.robust);
  std::vector<NamedCells> rules = found.stop_rules;
  for (NamedCells& rule : rules) rule.name = "stop at a half width of " + rule.name;
  addCells(table, rules);
  if (!found.two_intervals.cells.empty()) addCells(table, {found.two_intervals});
  return table;
}

TextTable placesLeftOutTable(const TrainingMeasurement& found) {
  TextTable table{{"places searched, of 12", "usable trials of 40", "T told, corrected", "coverage", "T told as it is"},
                  {}};
  for (const ExplorationRow& row : found.exploration) {
    table.rows.push_back({fmt::format("{}", row.searched), fmt::format("{:.1f}", row.usable),
                          fmt::format("{:.1f} %", 100.0 * row.corrected.truth + row.corrected.bias_points),
                          fmt::format("{:.3f}", row.corrected.coverage),
                          fmt::format("{:.1f} %", 100.0 * row.naive.truth + row.naive.bias_points)});
  }
  return table;
}

TextTable examTable(const TrainingMeasurement& found) {
  TextTable table{{"T", "40 trials: pass", "sequential: pass", "not yet", "repeat", "trials"}, {}};
  for (const ExamRow& row : found.exam) {
    const auto share = [](double value) { return fmt::format("{:.1f} %", 100.0 * value); };
    table.rows.push_back({percentPoints(row.truth), share(row.fixed_pass), share(row.pass), share(row.not_yet),
                          share(row.repeat), fmt::format("{:.1f}", row.mean_trials)});
  }
  return table;
}

TextTable peopleTable(const TrainingMeasurement& found) {
  TextTable table{{"what", "value"}, {}};
  const auto add = [&](const std::string& what, const std::string& value) { table.rows.push_back({what, value}); };
  const WorkedExample& example = found.example;
  add("89 trainees before, mean of reported T (SD)",
      fmt::format("{:.1f} % ({:.1f})", 100.0 * example.mean_before, 100.0 * example.sd_before));
  add("89 trainees after, mean of reported T (SD)",
      fmt::format("{:.1f} % ({:.1f})", 100.0 * example.mean_after, 100.0 * example.sd_after));
  for (const PowerRow& row : found.power) {
    add(fmt::format("power, {} trainees, 28 to 14 %, paired test", row.people), fmt::format("{:.3f}", row.power));
  }
  for (const LearningRow& row : found.learning) {
    add(fmt::format("six sessions of {} trials: error of ln T, separate / filtered (bias)", row.trials),
        fmt::format("{:.3f} / {:.3f} ({:+.3f})", row.separate_error, row.filtered_error, row.filtered_bias));
  }
  for (const ChangeRow& row : found.changes) {
    add(fmt::format("one person, {} and {} trials, factor {:.2f}: false alarms / 28 to 14 % seen", row.trials,
                    row.trials, row.factor),
        fmt::format("{:.3f} / {:.3f}", row.false_alarm, row.seen));
  }
  return table;
}

// ---------------------------------------------------------------------------------------------------------- figures

constexpr Marker kMethodMarkers[] = {Marker::circle, Marker::square, Marker::triangle, Marker::diamond, Marker::cross};

/// A value of each truth, by method.
template <class Value>
Plot methodPlot(const TrainingMeasurement& found, const std::string& title, const figures::Axis& axis,
                const Value& value) {
  Plot plot{.title = title};
  plot.x = {.label = "true threshold T", .unit = "%", .from = 0.0, .to = 45.0};
  plot.y = axis;
  std::size_t next = 0;
  for (const MethodRow& row : found.methods) {
    std::vector<double> x;
    std::vector<double> y;
    for (const RecoveryCell& cell : row.cells) {
      x.push_back(100.0 * cell.truth);
      y.push_back(value(cell));
    }
    plot.series.push_back(measuredSeries(nameOf(row.method), x, y, kMethodMarkers[next++ % 5]));
  }
  return plot;
}

Series dottedLevel(const std::string& name, double level, double from, double to) {
  return {.name = name, .x = {from, to}, .y = {level, level}, .stroke = Stroke::dotted, .colour = figures::kInk};
}

Plot biasPlot(const TrainingMeasurement& found) {
  Plot plot = methodPlot(found, "Recovery after 40 trials",
                         {.label = "bias of what is reported", .unit = "percentage points", .from = -2.0, .to = 2.0},
                         [](const RecoveryCell& cell) { return cell.bias_points; });
  plot.series.push_back(dottedLevel("bar", 1.0, 0.0, 45.0));
  plot.series.push_back(dottedLevel("", -1.0, 0.0, 45.0));
  return plot;
}

Plot coveragePlot(const TrainingMeasurement& found) {
  Plot plot = methodPlot(found, "How often the 95 % interval holds the truth",
                         {.label = "share of runs", .from = 0.9, .to = 1.0},
                         [](const RecoveryCell& cell) { return cell.coverage; });
  plot.series.push_back(dottedLevel("95 %", 0.95, 0.0, 45.0));
  return plot;
}

Plot convergencePlot(const TrainingMeasurement& found) {
  Plot plot{.title = "Convergence, over all thresholds"};
  plot.x = {.label = "trials", .from = 0.0};
  plot.y = {.label = "rms error of ln T", .scale = Scale::logarithmic, .from = 0.08, .to = 1.0};
  for (const MethodRow& row : found.methods) {
    Series series{.name = nameOf(row.method)};
    for (std::size_t i = 4; i < row.error_ln.size(); ++i) {
      series.x.push_back(static_cast<double>(i + 1));
      series.y.push_back(row.error_ln[i]);
    }
    plot.series.push_back(std::move(series));
  }
  plot.series.push_back(dottedLevel("15 %", 0.15, 0.0, static_cast<double>(found.methods.front().error_ln.size())));
  return plot;
}

Plot placesLeftOutPlot(const TrainingMeasurement& found) {
  Plot plot{.title = "Places left out, T of 28 %"};
  plot.x = {.label = "places searched, of 12", .from = 5.0, .to = 13.0, .ticks = ticksAt({6.0, 8.0, 12.0})};
  plot.y = {.label = "threshold that is told", .unit = "%", .from = 0.0, .to = 90.0};
  std::vector<double> searched;
  std::vector<double> corrected;
  std::vector<double> naive;
  for (const ExplorationRow& row : found.exploration) {
    searched.push_back(row.searched);
    corrected.push_back(100.0 * row.corrected.truth + row.corrected.bias_points);
    naive.push_back(100.0 * row.naive.truth + row.naive.bias_points);
  }
  plot.series = {measuredSeries("as it is", searched, naive, Marker::cross),
                 measuredSeries("corrected", searched, corrected), dottedLevel("truth", 28.0, 5.0, 13.0)};
  return plot;
}

Plot examPlot(const TrainingMeasurement& found) {
  Plot plot{.title = "Examination at a mark of 20 %"};
  plot.x = {.label = "true threshold T", .unit = "%", .from = 12.0, .to = 30.0};
  plot.y = {.label = "share of runs", .from = 0.0, .to = 1.0};
  std::vector<double> truth;
  std::vector<double> pass;
  std::vector<double> repeat;
  std::vector<double> fixed;
  for (const ExamRow& row : found.exam) {
    truth.push_back(100.0 * row.truth);
    pass.push_back(row.pass);
    repeat.push_back(row.repeat);
    fixed.push_back(row.fixed_pass);
  }
  plot.series = {measuredSeries("pass, 40 trials", truth, fixed),
                 measuredSeries("pass, sequential", truth, pass, Marker::square),
                 measuredSeries("repeat, sequential", truth, repeat, Marker::triangle)};
  plot.shapes = {verticalLine("mark", 20.0, 0.0, 1.0)};
  return plot;
}

Plot learnerPlot(const LearningExample& learner) {
  Plot plot{.title = "One trainee over six sessions of 40 trials"};
  plot.x = {.label = "session", .from = 0.5, .to = static_cast<double>(learner.truth.size()) + 0.5};
  plot.y = {.label = "threshold T", .unit = "%", .from = 0.0, .to = 50.0};
  Series points{.name = "filtered, 95 %", .stroke = Stroke::none, .marker = Marker::circle, .colour = figures::kBlue};
  figures::Shape intervals{.closed = false, .colour = figures::kBlue};
  Series truth{.name = "truth", .stroke = Stroke::dashed, .colour = figures::kInk};
  for (std::size_t i = 0; i < learner.truth.size(); ++i) {
    const double session = static_cast<double>(i) + 1.0;
    const training::ThresholdSummary& told = learner.points[i].threshold;
    points.x.push_back(session);
    points.y.push_back(100.0 * told.median);
    intervals.paths.push_back({Vec2(session, 100.0 * told.low), Vec2(session, 100.0 * told.high)});
    truth.x.push_back(session);
    truth.y.push_back(100.0 * learner.truth[i]);
  }
  plot.shapes.push_back(std::move(intervals));
  Series fitted{.name = "exponential fit", .colour = figures::kVermilion};
  Series low{.name = "its 95 % band", .stroke = Stroke::dotted, .colour = figures::kVermilion};
  Series high{.name = "", .stroke = Stroke::dotted, .colour = figures::kVermilion};
  if (learner.fit) {
    for (const training::CurvePoint& point : learner.fit->curve) {
      for (Series* series : {&fitted, &low, &high}) series->x.push_back(point.session + 1.0);
      fitted.y.push_back(100.0 * point.median);
      low.y.push_back(100.0 * point.low);
      high.y.push_back(100.0 * point.high);
    }
  }
  plot.series = {truth, points, fitted, low, high};
  return plot;
}

Plot groupPlot(const WorkedExample& example) {
  Plot plot{.title = "89 trainees before and after"};
  plot.x = {.label = "reported threshold", .unit = "%", .from = 0.0, .to = 60.0};
  plot.y = {.label = "share of trainees below", .from = 0.0, .to = 1.0};
  for (const auto& [name, values] : {std::pair("before", &example.before), std::pair("after", &example.after)}) {
    Series series{.name = name};
    for (std::size_t i = 0; i < values->size(); ++i) {
      series.x.push_back(std::min(60.0, 100.0 * (*values)[i]));
      series.y.push_back((static_cast<double>(i) + 0.5) / static_cast<double>(values->size()));
    }
    plot.series.push_back(std::move(series));
  }
  plot.shapes = {verticalLine("28 and 14 %", 28.0, 0.0, 1.0), verticalLine("", 14.0, 0.0, 1.0)};
  return plot;
}

// ------------------------------------------------------------------------------------------------------------- page

std::vector<std::string> methodTexts(const TrainingMeasurement& found) {
  const TrainingPlan& plan = found.plan;
  return {
      "A trainee is a psychometric function: right with probability guess + (1 - guess - lapse) F, "
      "F = 1 - exp(-ln 2 (d / T)^slope), among twelve places, lapse rate 2 %, slope 1.8. Levels, posterior, stop rules "
      "and verdicts are the product's (instruments/teach/palpate/training); QUEST, psi over all parameters, "
      "3-down-1-up and the weighted staircase stand beside it in instruments/teach/study/asked_test.cpp, with the "
      "product's posterior.",
      fmt::format("{} runs of each cell of marginal psi, {} of the other methods{}; seed {}, another for each run. "
                  "Bias is the mean of reported medians less the truth; coverage the share of 95 % intervals that hold "
                  "it.",
                  counted(static_cast<double>(plan.runs)), counted(static_cast<double>(plan.beside_runs)),
                  plan.all ? fmt::format(", {} of what lies outside the model", plan.robust_runs) : "", plan.seed),
      "Who leaves places out feels so many of twelve, drawn again in each trial, and answers among them with the "
      "threshold that an ideal observer has among so many; where the target is not among them the answer is wrong.",
      "The 89 trainees lie evenly over a lognormal of 0.30 around 28 %, then 14 %, before and after unrelated: with "
      "what a test of 40 trials adds, the published spread. Howell et al., BMC Medical Education 8:14, 2008."};
}

std::string trainingCommand(const StudySettings& settings, const TrainingPlan& plan) {
  if (!settings.seed && !settings.cases) return {};
  return fmt::format("palpate study training --seed {} --cases {}{} --out DIR", plan.seed, plan.runs,
                     settings.quick ? " --quick" : "");
}

std::vector<StudyFigure> trainingFigures(const TrainingMeasurement& found) {
  return {
      {"training_recovery",
       "Bias of reported thresholds, how often their intervals hold the truth, and how the error falls with trials.",
       Figure{.panels = {biasPlot(found), coveragePlot(found), convergencePlot(found)}, .columns = 3}},
      {"training_exams", "What places that are never pressed do to a threshold; who passes an examination.",
       Figure{.panels = {placesLeftOutPlot(found), examPlot(found)}, .columns = 2}},
      {"training_learning", "A simulated trainee who learns, and the published group again.",
       Figure{.panels = {learnerPlot(found.learner), groupPlot(found.example)}, .columns = 2}}};
}

StudyPage studyTraining(const StudySettings& settings) {
  if (settings.family == kEyeObserver) return studyEye(settings);
  TrainingPlan plan = trainingPlan(settings.quick, settings.cases);
  plan.seed = settings.seed.value_or(plan.seed);
  const TrainingMeasurement found = measureTraining(plan, settings.progress);
  std::vector<StudyTable> tables = {
      {"training_bars", "What is asked for and what is reached.", trainingBarTable(found)},
      {"training_methods", "Thresholds after 40 trials, by method.", methodTable(found)},
      {"training_readings", "What the same trials say without a fit.", readingTable(found)},
      {"training_exploration", "Trainees who leave places out, T of 28 %.", placesLeftOutTable(found)},
      {"training_exam", "Examination at a mark of 20 %.", examTable(found)},
      {"training_people", "Groups, sessions, one person twice.", peopleTable(found)}};
  if (!found.robust.empty()) {
    tables.push_back({"training_outside", "Outside the model, and other lengths.", outsideTable(found)});
  }
  return {.title = "Thresholds of simulated trainees",
          .question =
              "A test of palpation says what change a person can just feel. Does it give back the threshold that "
              "a simulated trainee has, and how surely; after how many trials; what if places are left out, if "
              "the trainee is unlike what is assumed; and can an examination and a course be judged by it?",
          .findings = trainingFindings(found),
          .method = methodTexts(found),
          .tables = std::move(tables),
          .figures = trainingFigures(found),
          .numbers = trainingPairs(found),
          .numbers_on_top = true,
          .command = trainingCommand(settings, plan)};
}

}  // namespace

Study trainingStudy() {
  return {.name = "training",
          .what = "Thresholds of simulated trainees: bias, spread, coverage, examination, places left out, a course",
          .run = studyTraining,
          .draws = true,
          .families = {std::string(kEyeObserver)},
          .family_cases = kEyeTests};
}

}  // namespace palpate::study
