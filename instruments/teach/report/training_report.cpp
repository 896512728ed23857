// Finds the report's trainee, and states the main results.
#include "teach/report/training_report.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <set>

#include "palpate/base/error.h"
#include "palpate/base/language.h"
#include "palpate/training/psychometric.h"
#include "palpate/training/records/trainee_code.h"
#include "report/page/study_page.h"
#include "teach/commands/results_commands.h"

namespace palpate::app {

namespace {

using training::SessionKind;
using training::ThresholdPoint;
using training::TraineeStatistics;
using training::TrialStatistics;

constexpr std::size_t kPseudonymLetters = 8;
/// A blank at which no line ends (U+00A0).
constexpr std::string_view kNoBreak = "\u00a0";

/// Everything that is not of that trainee; with the word for it.
struct WantedTrainee {
  training::Uuid id;
  std::string name;
};

WantedTrainee wantedTrainee(const TrainingReportSettings& settings, training::Store& store) {
  const std::vector<training::TraineeRow> trainees = store.trainees();
  if (const auto code = training::codeTyped(settings.trainee)) {
    for (const training::Uuid& id : store.derivePseudonyms(*code)) {
      if (std::ranges::count(trainees, id, &training::TraineeRow::id) > 0) return {id, *code};
    }
  }
  std::vector<training::Uuid> found;
  for (const training::TraineeRow& row : trainees) {
    if (settings.trainee.size() >= kPseudonymLetters && row.id.starts_with(settings.trainee)) found.push_back(row.id);
  }
  if (found.size() == 1) return {found.front(), shortPseudonym(found.front())};
  throw Error::inFile(store.file().string(), found.empty() ? fmt::format("has no trainee '{}'", settings.trainee)
                                                           : fmt::format("has {} trainees '{}...'; give more letters",
                                                                         found.size(), settings.trainee));
}

std::string classTitle(const std::vector<training::ClassRow>& classes, const std::string& id) {
  for (const training::ClassRow& row : classes) {
    if (row.id == id) return row.label.empty() ? row.id : fmt::format("{} ({})", row.label, row.id);
  }
  return id;
}

/// Quartiles behind a trainee's own curve.
std::vector<training::Occasion> selectOccasions(const training::TrainingStatistics& all) {
  std::vector<training::Occasion> occasions = all.all.occasions;
  std::erase_if(occasions, [](const training::Occasion& occasion) {
    return occasion.medians.count < static_cast<std::size_t>(kMinOthers);
  });
  return occasions;
}

/// The trainee's own rows, and the class's quartiles.
void limitToTrainee(TrainingReport& report, const WantedTrainee& wanted) {
  report.name = wanted.name;
  const auto at = std::ranges::find(report.record.trainees, wanted.id, [](const auto& one) { return one.row.id; });
  const std::string class_id = at->row.class_id;
  training::TrainingRecord others = report.record;
  std::erase_if(others.trainees, [&](const auto& one) { return one.row.class_id != class_id; });
  if (others.trainees.size() >= static_cast<std::size_t>(kMinOthers)) {
    report.others = selectOccasions(training::trainingStatistics(others, {.curves = false, .groups = false}));
  }
  report.class_words = classTitle(report.record.classes, class_id);
  std::erase_if(report.record.trainees, [&](const auto& one) { return one.row.id != wanted.id; });
}

// ---- sentences

std::string resultSentence(const TraineeStatistics& trainee, bool found_lumps) {
  const ThresholdPoint* latest = trainee.latest();
  if (found_lumps && trainee.points.empty()) return {};  // sessions with lumps alone have sentences of their own
  if (latest == nullptr) return tr("No result yet: no block has enough answers for a threshold.");
  const auto& t = *latest->threshold;
  if (!t.isConclusive()) {
    return trnf("Smallest reliable change: more trials needed ({} answer so far, in the {} of {}).",
                "Smallest reliable change: more trials needed ({} answers so far, in the {} of {}).",
                static_cast<std::size_t>(latest->trials.counted), latest->trials.counted,
                occasionName(latest->kind, latest->nth), formatDay(latest->start_ms));
  }
  return trf("Smallest reliable change: about {} of {}, measured in the {} of {} with {} answers.", formatThreshold(t),
             changeMeaningName(latest->meaning), occasionName(latest->kind, latest->nth), formatDay(latest->start_ms),
             latest->trials.counted);
}

std::string comparisonSentence(const TraineeStatistics& trainee) {
  if (!trainee.compared) return {};
  const ThresholdPoint& before = trainee.points[trainee.compared->before];
  const ThresholdPoint& now = trainee.points[trainee.compared->now];
  const std::string first =
      trf("First test ({}): {}.", occasionName(before.kind, before.nth), formatChange(before.threshold->median));
  if (trainee.compared->why_not) {
    return first + " " + trf("The two are not compared: {}.", tr(trainee.compared->why_not->c_str()));
  }
  const training::ThresholdChange& change = trainee.compared->change;
  if (!change.clear) return first + " " + tr("Too early to call a change.");
  const std::string now_words = formatChange(now.threshold->median);
  const std::string clear = change.ratio < 1.0 ? trf("Now {} ({:.2f} times, {:.2f} to {:.2f}): a clear improvement.",
                                                     now_words, change.ratio, change.low, change.high)
                                               : trf("Now {} ({:.2f} times, {:.2f} to {:.2f}): a clear loss.",
                                                     now_words, change.ratio, change.low, change.high);
  return first + " " + clear;
}

/// Tests in which answers in a row were like guesses.
std::string attentionSentence(const TraineeStatistics& trainee) {
  std::string tests;
  for (const ThresholdPoint& point : trainee.points) {
    if (!training::isTest(point.kind) || !point.attention.warned()) continue;
    tests += (tests.empty() ? "" : ", ") + trf("{} ({} of {} easy changes missed)", occasionName(point.kind, point.nth),
                                               point.attention.easy_missed, point.attention.easy);
  }
  if (tests.empty()) return {};
  return trf("Inattention: in {} answers in a row were like guesses; the threshold may be too high.", tests);
}

std::string examSentence(const TraineeStatistics& trainee) {
  const ThresholdPoint* exam = nullptr;
  for (const ThresholdPoint& point : trainee.points) {
    if (point.kind == SessionKind::exam && point.finished) exam = &point;
  }
  if (exam == nullptr || exam->verdict == training::Verdict::none) return {};
  const std::string day = formatDay(exam->start_ms);
  if (exam->verdict == training::Verdict::pass) return trf("Examination of {}: passed.", day);
  if (exam->verdict == training::Verdict::not_yet) return trf("Examination of {}: not yet.", day);
  return trf("Examination of {}: to be repeated (too close to call).", day);
}

std::string answersSentence(const TrialStatistics& trials, std::string_view what) {
  if (trials.shown == 0) return {};
  std::string text =
      trf("{}: {} of {} counted answers were right; a trial took {:.0f} s (median) and {:.1f} places were felt.", what,
          trials.correct, trials.counted, trials.seconds.median, trials.places_felt.mean);
  if (trials.excluded > 0) {
    text += " " + trnf("{} trial is left out.", "{} trials are left out.", static_cast<std::size_t>(trials.excluded),
                       trials.excluded);
  }
  return text;
}

std::string lapseSentence(const TrialStatistics& tests) {
  if (tests.easy == 0) return {};
  if (10 * tests.easy_wrong <= tests.easy) {
    return trf("Of {} easy trials in tests {} went wrong.", tests.easy, tests.easy_wrong);
  }
  return trf("Of {} easy trials in tests {} went wrong: attention may have lapsed, so read the results with care.",
             tests.easy, tests.easy_wrong);
}

std::string groupSentence(const training::Occasion& occasion) {
  const std::size_t count = occasion.medians.count;
  const std::string words = occasionName(occasion.kind, occasion.nth);
  std::string text;
  if (occasion.group.people >= 2) {
    text = trnf("{}: {} trainee, mean smallest reliable change {} (95 % interval {} to {}), standard deviation {}.",
                "{}: {} trainees, mean smallest reliable change {} (95 % interval {} to {}), standard deviation {}.",
                count, words, count, formatChange(occasion.group.mean), formatChange(occasion.group.low),
                formatChange(occasion.group.high), formatChange(occasion.group.sd));
  } else {
    text = trnf("{}: {} trainee, median {}.", "{}: {} trainees, median {}.", count, words, count,
                formatChange(occasion.medians.median));
  }
  text[0] = text[0] >= 'a' && text[0] <= 'z' ? static_cast<char>(text[0] - 'a' + 'A') : text[0];
  return text;
}

/// A factor of at least 1 means better: they feel a smaller change.
std::string changedBy(double factor) {
  return factor >= 1.0 ? trf("{:.2f} times smaller", factor) : trf("{:.2f} times larger", 1.0 / factor);
}

std::string classChangeSentence(const training::ClassChange& change) {
  if (change.group.people < 2) return {};
  const std::string changed =
      trf("From first to last test, {} trainees: the change that they need became {} (95 % interval {} to {}).",
          change.trainees, changedBy(change.group.factor), changedBy(change.group.low), changedBy(change.group.high));
  if (!change.group.real()) return changed + " " + tr("Too early to call a change.");
  return changed + " " +
         trf("Single trainees: {} clearly better, {} clearly worse, {} too early to call.", change.clearly_better,
             change.clearly_worse, change.trainees - change.clearly_better - change.clearly_worse);
}

std::vector<std::string> classSentences(const TrainingReport& report) {
  const training::ClassStatistics& all = report.statistics.all;
  const std::size_t trainees = report.statistics.trainees.size();
  std::vector<std::string> sentences = {trnf("{} trainee.", "{} trainees.", trainees, trainees)};
  const training::Occasion* first = nullptr;
  const training::Occasion* last = nullptr;
  for (const training::Occasion& occasion : all.occasions) {
    if (!training::isTest(occasion.kind) || occasion.kind == SessionKind::exam) continue;
    if (first == nullptr) first = &occasion;
    last = &occasion;
  }
  if (first != nullptr) sentences.push_back(groupSentence(*first));
  if (last != first) sentences.push_back(groupSentence(*last));
  if (all.change) sentences.push_back(classChangeSentence(*all.change));
  sentences.push_back(answersSentence(all.tests, tr("Tests")));
  sentences.push_back(answersSentence(all.practice, tr("Practice")));
  sentences.push_back(lapseSentence(all.tests));
  return sentences;
}

std::string devicesSentence(const TrainingReport& report) {
  std::set<std::string> devices;
  for (const TraineeStatistics& trainee : report.statistics.trainees) {
    for (const ThresholdPoint& point : trainee.points) devices.insert(point.device);
  }
  if (devices.size() < 2) return {};
  return trf("{} devices were used. A threshold belongs to its device and thimble: do not compare across them.",
             devices.size());
}

}  // namespace

TrainingReport trainingReport(const TrainingReportSettings& settings, const Progress& progress) {
  palpate::report(progress, "reading", 0.0);
  training::Store store = recordsAt(settings.file.string(), training::Store::Open::read_only);
  TrainingReport report;
  report.file = store.file();
  report.record = training::trainingRecord(store, [&](const training::TraineeRow& row) {
    return settings.only_class.empty() || row.class_id == settings.only_class;
  });
  if (!settings.only_class.empty() && report.record.trainees.empty()) {
    throw Error::inFile(report.file.string(), fmt::format("has no trainee of class '{}'", settings.only_class));
  }
  palpate::report(progress, "computing", 0.0);
  if (!settings.trainee.empty()) {
    limitToTrainee(report, wantedTrainee(settings, store));
  } else if (report.record.trainees.size() == 1 && !settings.whole_class && settings.only_class.empty()) {
    const training::Uuid id = report.record.trainees.front().row.id;
    limitToTrainee(report, {id, shortPseudonym(id)});
  } else {
    report.of_class = true;
    report.class_words = settings.only_class.empty() ? "" : classTitle(report.record.classes, settings.only_class);
  }
  report.statistics =
      training::trainingStatistics(report.record, {.curves = !report.of_class, .groups = report.of_class});
  report.lumps = training::lumpGroups(report.record);
  return report;
}

std::vector<std::string> trainingSentences(const TrainingReport& report) {
  std::vector<std::string> sentences;
  if (report.statistics.trainees.empty()) {
    sentences.emplace_back(tr("No trainee has any record here yet."));
  } else if (report.of_class) {
    sentences = classSentences(report);
  } else {
    const TraineeStatistics& trainee = report.statistics.trainees.front();
    sentences = {resultSentence(trainee, !report.lumps.empty()),
                 comparisonSentence(trainee),
                 attentionSentence(trainee),
                 examSentence(trainee),
                 answersSentence(trainee.tests, tr("Tests")),
                 answersSentence(trainee.practice, tr("Practice")),
                 lapseSentence(trainee.tests)};
  }
  for (std::string& sentence : lumpSentences(report)) sentences.push_back(std::move(sentence));
  sentences.push_back(devicesSentence(report));
  sentences.emplace_back(tr(kNotShown));
  std::erase(sentences, std::string());
  return sentences;
}

std::string occasionName(SessionKind kind, int nth) {
  switch (kind) {
    case SessionKind::practice:
      return trf("practice {}", nth);
    case SessionKind::mastery:
      return trf("mastery {}", nth);
    case SessionKind::pre_test:
      return nth == 1 ? tr("pre-test") : trf("pre-test {}", nth);
    case SessionKind::post_test:
      return nth == 1 ? tr("post-test") : trf("post-test {}", nth);
    case SessionKind::exam:
      return nth == 1 ? tr("examination") : trf("examination {}", nth);
    case SessionKind::retention:
      return nth == 1 ? tr("retention test") : trf("retention test {}", nth);
    case SessionKind::lump:
      return trf("lumps {}", nth);
    case SessionKind::lump_exam:
      return nth == 1 ? tr("examination with lumps") : trf("examination with lumps {}", nth);
    case SessionKind::free:
      break;
  }
  return tr("free exploration");
}

std::string changeMeaningName(training::ChangeMeaning meaning) {
  if (meaning == training::ChangeMeaning::cue) return tr("the cue of a lump");
  return meaning == training::ChangeMeaning::compliance ? tr("compliance") : tr("stiffness");
}

std::string verdictName(training::Verdict verdict) {
  switch (verdict) {
    case training::Verdict::pass:
      return tr("pass");
    case training::Verdict::not_yet:
      return tr("not yet");
    case training::Verdict::repeat:
      return tr("repeat");
    case training::Verdict::none:
      break;
  }
  return kNoValue;
}

std::string shortPseudonym(const training::Uuid& id) { return id.substr(0, kPseudonymLetters); }

std::string formatChange(double change) {
  return fmt::format("{:.{}f}{}%", WrittenNumber{100.0 * change}, change < 0.0995 ? 1 : 0, kNoBreak);
}

std::string formatThreshold(const training::ThresholdSummary& threshold) {
  if (!threshold.isConclusive()) return tr(training::kMoreTrialsNeeded);
  const std::string from = formatChange(threshold.low);
  return trf("{} ({} to {})", formatChange(threshold.median), from.substr(0, from.find(kNoBreak)),
             formatChange(threshold.high));
}

std::string formatDay(std::int64_t utc_ms) {
  if (utc_ms <= 0) return tr("no date");
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(static_cast<std::time_t>(utc_ms / 1000)));
}

}  // namespace palpate::app
