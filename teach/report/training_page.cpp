// The page from its summary to its definitions. Pictures have their words beside them, so it can be read as text.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/json_text.h"
#include "palpate/body/torso.h"
#include "palpate/training/psychometric.h"
#include "report/recording/report_html.h"
#include "teach/report/training_figures.h"
#include "teach/report/training_report.h"

namespace palpate::app {

namespace {

using training::ThresholdPoint;
using training::TraineeStatistics;
using training::TrialStatistics;

/// Sites of whoever has sites of their own are found by the words of their protocol.
std::optional<ReportBack> reportBack(const TrainingReport& report) {
  const body::Torso torso = body::makeTorso();
  ReportBack back{.skin = torso.skin.mesh, .sites = {}};
  try {
    std::vector<std::string> places;
    for (const training::ProtocolRow& row : report.record.protocols) {
      if (const auto* protocol = training::protocolOf(report.record, row.id, row.version)) places = protocol->sites;
    }
    back.sites =
        places.empty() ? training::twelveSites(torso.landmarks) : training::sitesNamed(torso.landmarks, places);
  } catch (const Error&) {
    return std::nullopt;  // places of another body: the tables tell
  }
  return back;
}

class PageWriter {
 public:
  PageWriter(const TrainingReport& report, const Progress& progress)
      : report_(report),
        progress_(progress),
        tests_(report.statistics.all.tests),
        practice_(report.statistics.all.practice) {}

  std::string page() {
    const std::string name =
        report_.of_class ? "Training report: class" : fmt::format("Training report: trainee {}", report_.name);
    html_ = pageBegin(name) + summaryOf(trainingSentences(report_)) + trainingFacts(report_);
    if (tests_.shown + practice_.shown > 0) {
      report_.of_class ? classSections() : traineeSections();
      accuracy();
      coverage();
      handling();
      seconds();
      answers();
    }
    if (report_.of_class && !report_.statistics.trainees.empty()) {
      add("<h2>Every trainee</h2>\n" + traineesTable(report_.statistics));
    }
    if (!report_.statistics.trainees.empty()) add(qualitySection(report_));
    definitions();
    numbers();
    return html_ + std::string(kPageEnd);
  }

 private:
  void add(const std::string& html) { html_ += html; }
  void addHeading(std::string_view words) { html_ += elementOf("h2", words) + "\n"; }
  void addPicture(const TrainingPicture& picture) {
    palpate::report(progress_, "drawing " + picture.id, 0.0);
    add(figureHtml(picture.id, picture.figure, picture.alternative, picture.caption));
    add(foldedHtml("The picture in words", elementOf("p", picture.alternative)));
  }

  void traineeSections() {
    const TraineeStatistics& trainee = report_.statistics.trainees.front();
    addHeading("Learning curve");
    if (!trainee.curve.empty()) addPicture(curvePicture(trainee, report_.others));
    add(blocksTable(trainee));
    std::vector<const ThresholdPoint*> fitted;
    for (const bool tests : {true, false}) {
      if (!fitted.empty()) break;  // practice is shown where there was no test
      for (const ThresholdPoint& point : trainee.points) {
        if (point.threshold && training::isTest(point.kind) == tests) fitted.push_back(&point);
      }
    }
    if (fitted.empty()) return;
    if (fitted.size() > 2) fitted.erase(fitted.begin() + 1, fitted.end() - 1);
    addHeading("Fitted function");
    addPicture(fitPicture(fitted));
    add(fitsTable(trainee));
  }

  void classSections() {
    const training::ClassStatistics& all = report_.statistics.all;
    addHeading("Learning curve");
    if (all.occasions.empty()) add("<p>No block has enough answers for a threshold.</p>\n");
    if (!all.occasions.empty()) addPicture(classCurvePicture(report_.statistics));
    add(occasionsTable(all));
    if (all.collapsed.empty()) return;
    addHeading("Fitted function");
    addPicture(collapsedPicture(all.collapsed));
  }

  TestsAndPracticeShown shown() const { return {&tests_, &practice_}; }
  bool anyCounted() const { return tests_.counted + practice_.counted > 0; }

  void accuracy() {
    if (!anyCounted()) return;
    addHeading("Right answers");
    addPicture(accuracyPicture(shown()));
    add(levelsTable(tests_, "tests") + levelsTable(practice_, "practice"));
  }

  void coverage() {
    palpate::report(progress_, "building the back", 0.0);
    addHeading("What was felt");
    const std::optional<ReportBack> back = reportBack(report_);
    for (const auto& [trials, what] :
         {std::pair{&tests_, std::string("tests")}, {&practice_, std::string("practice")}}) {
      if (trials->shown == trials->warm_up) continue;
      if (back) {
        TrainingPicture picture = coveragePicture(*trials, *back, what);
        picture.id += "_" + what;
        addPicture(picture);
      }
      add(sitesTable(*trials, back ? back->sites : training::SiteSet{}, what));
    }
  }

  void handling() {
    addHeading("Force and speed");
    if (anyCounted()) addPicture(handlingPicture(shown()));
    add(handlingTable(tests_, practice_));
  }

  void seconds() {
    addHeading("Time for a trial");
    if (anyCounted()) addPicture(secondsPicture(shown()));
    add(secondsTable(tests_, practice_));
  }

  void answers() {
    if (!anyCounted()) return;
    addHeading("Which site was taken for which");
    for (const auto& [trials, what] :
         {std::pair{&tests_, std::string("tests")}, {&practice_, std::string("practice")}}) {
      if (trials->counted == 0) continue;
      TrainingPicture picture = answersPicture(*trials, what);
      picture.id += "_" + what;
      addPicture(picture);
      add(answersTable(*trials, what));
    }
  }

  void definitions() {
    const std::vector<std::pair<std::string, std::string>> words = {
        {"Smallest reliable change, T", std::string(training::kThresholdDefinition) +
                                            ". It belongs to the device, the thimble and the number of places asked "
                                            "about. How often places were felt changes it too: read it with places "
                                            "felt and time."},
        {"95 %", "Of T: the middle 95 % of what the answers leave open (posterior). Of shares: Wilson's interval."},
        {"So far",
         "What all blocks up to this one say together, where T may have wandered by a fifth from each to the "
         "next. Another device begins again."},
        {"Too early to call a change",
         "The difference of two results (of ln T) is no larger than the root of the sum "
         "of squares of the halves of their 95 % intervals."},
        {"Mean of the group",
         "A two-level model: ln T is normally distributed between trainees, and each trainee is known as "
         "well as the answers tell. Not the mean of single results, which are drawn towards what was "
         "believed before."},
        {"Counted",
         "No warm-up, and the true place was felt (pressed hard and long enough). Who never felt it cannot "
         "find it; guessing is then among the places that were felt."},
        {"Search, palpation", "On the skin: moving faster than 20 mm/s, or slower."},
        {"What is not shown", std::string(kNotShown)}};
    add("<h2>What the words mean</h2>\n<dl>\n");
    for (const auto& [word, meaning] : words) add(elementOf("dt", word) + elementOf("dd", meaning) + "\n");
    add("</dl>\n");
  }

  /// In the page for programs; markup letters are escaped as JSON has it, so that they are none.
  void numbers() {
    std::string text = jsonDump(trainingReportJson(report_), -1, true);
    for (const auto& [letter, escaped] : {std::pair{'<', "\\u003c"}, {'>', "\\u003e"}, {'&', "\\u0026"}}) {
      for (std::size_t at = text.find(letter); at != std::string::npos; at = text.find(letter, at)) {
        text.replace(at, 1, escaped);
      }
    }
    add("<script type=\"application/json\" id=\"numbers\">" + text + "</script>\n");
  }

  const TrainingReport& report_;
  const Progress& progress_;
  const TrialStatistics& tests_;
  const TrialStatistics& practice_;
  std::string html_;
};

}  // namespace

std::string trainingPage(const TrainingReport& report, const Progress& progress) {
  return PageWriter(report, progress).page();
}

}  // namespace palpate::app
