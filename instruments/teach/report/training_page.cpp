// The page from its summary to its definitions. Pictures have texts next to them, so it can be read as text.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/json.h"
#include "palpate/base/language.h"
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

/// Custom sites are found by the place names of their protocol.
std::optional<ReportBack> reportBack(const TrainingReport& report) {
  const body::Torso torso = body::makeTorso();
  ReportBack back{.skin = torso.skin.mesh, .sites = {}};
  try {
    std::vector<std::string> places;
    for (const training::ProtocolRow& row : report.record.protocols) {
      if (const auto* protocol = training::findProtocol(report.record, row.id, row.version)) places = protocol->sites;
    }
    back.sites =
        places.empty() ? training::twelveSites(torso.landmarks) : training::sitesNamed(torso.landmarks, places);
  } catch (const Error&) {
    return std::nullopt;  // places of another body: the tables have them
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
        report_.of_class ? tr("Training report: class") : trf("Training report: trainee {}", report_.name);
    html_ = pageBegin(name) + summaryHtml(trainingSentences(report_)) + trainingFacts(report_);
    if (tests_.shown + practice_.shown > 0) {
      report_.of_class ? classSections() : traineeSections();
      accuracy();
      coverage();
      handling();
      seconds();
      answers();
    }
    add(lumpSections(report_));
    if (report_.of_class && !report_.statistics.trainees.empty()) {
      add(headingHtml(tr("Every trainee")));
      add(traineesTable(report_.statistics));
    }
    if (!report_.statistics.trainees.empty()) add(qualitySection(report_));
    definitions();
    numbers();
    return html_ + std::string(kPageEnd);
  }

 private:
  void add(const std::string& html) { html_ += html; }
  void addPicture(const TrainingPicture& picture) {
    palpate::report(progress_, "drawing " + picture.id, 0.0);
    add(figureHtml(picture.id, picture.figure, picture.alternative, picture.caption));
    add(foldedHtml(tr("The picture in words"), htmlElement("p", picture.alternative)));
  }

  void traineeSections() {
    const TraineeStatistics& trainee = report_.statistics.trainees.front();
    add(headingHtml(tr("Learning curve")));
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
    add(headingHtml(tr("Fitted function")));
    addPicture(fitPicture(fitted));
    add(fitsTable(trainee));
  }

  void classSections() {
    const training::ClassStatistics& all = report_.statistics.all;
    add(headingHtml(tr("Learning curve")));
    if (all.occasions.empty()) add(paragraphHtml(tr("No block has enough answers for a threshold.")));
    if (!all.occasions.empty()) addPicture(classCurvePicture(report_.statistics));
    add(occasionsTable(all));
    if (all.collapsed.empty()) return;
    add(headingHtml(tr("Fitted function")));
    addPicture(collapsedPicture(all.collapsed));
  }

  /// With their words in English, of which ids in the page are made.
  std::array<std::pair<const TrialStatistics*, const char*>, 2> bothParts() const {
    return {{{&tests_, toTranslate("tests")}, {&practice_, toTranslate("practice")}}};
  }
  bool anyCounted() const { return tests_.counted + practice_.counted > 0; }

  void accuracy() {
    if (!anyCounted()) return;
    add(headingHtml(tr("Right answers")));
    addPicture(accuracyPicture(tests_, practice_));
    add(levelsTable(tests_, tr("tests")) + levelsTable(practice_, tr("practice")));
  }

  void coverage() {
    palpate::report(progress_, "building the back", 0.0);
    add(headingHtml(tr("What was felt")));
    const std::optional<ReportBack> back = reportBack(report_);
    for (const auto& [trials, what] : bothParts()) {
      if (trials->shown == trials->warm_up) continue;
      if (back) {
        TrainingPicture picture = coveragePicture(*trials, *back, tr(what));
        picture.id += std::string("_") + what;
        addPicture(picture);
      }
      add(sitesTable(*trials, back ? back->sites : training::SiteSet{}, tr(what)));
    }
  }

  void handling() {
    add(headingHtml(tr("Force and speed")));
    if (anyCounted()) addPicture(handlingPicture(tests_, practice_));
    add(measuresTable(tests_, practice_, true));
  }

  void seconds() {
    add(headingHtml(tr("Time for a trial")));
    if (anyCounted()) addPicture(secondsPicture(tests_, practice_));
    add(measuresTable(tests_, practice_, false));
  }

  void answers() {
    if (!anyCounted()) return;
    add(headingHtml(tr("Which sites were confused")));
    for (const auto& [trials, what] : bothParts()) {
      if (trials->counted == 0) continue;
      TrainingPicture picture = answersPicture(*trials, tr(what));
      picture.id += std::string("_") + what;
      addPicture(picture);
      add(answersTable(*trials, tr(what)));
    }
  }

  void definitions() {
    const std::vector<std::pair<std::string, std::string>> words = {
        {tr("Smallest reliable change, T"),
         fmt::format("{}. {}", tr(training::kThresholdDefinition),
                     tr("It belongs to the device, the thimble and the number of places asked about. How often places "
                        "were felt changes it too: read it with places felt and time."))},
        {"95 %", tr("Of T: the middle 95 % of what the answers leave open (posterior). Of shares: Wilson's interval.")},
        {tr("So far"), tr("The estimate from all blocks up to this one, where T may drift by a fifth from each to the "
                          "next. It starts again with another device.")},
        {tr("Too early to call a change"),
         tr("The difference of two results (of ln T) is no larger than the root of the "
            "sum of squares of the halves of their 95 % intervals.")},
        {tr("Mean of the group"),
         tr("A two-level model: ln T is normally distributed between trainees, and each trainee is known as well as "
            "the answers allow. It is not the mean of single results, which are pulled towards the prior.")},
        {tr("Counted"),
         tr("Trials after the warm-up in which the true place was felt (pressed hard and long enough). A place that "
            "was not felt cannot be found; guessing is then among the places that were felt.")},
        {tr("Search, palpation"), tr("On the skin: moving faster than 20 mm/s, or slower.")},
        {tr("What is not shown"), tr(kNotShown)}};
    add(definitionsHtml(words));
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
