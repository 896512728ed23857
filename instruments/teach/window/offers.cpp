#include "teach/window/offers.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "palpate/base/language.h"
#include "palpate/training/records/store.h"

namespace palpate::viewer {

namespace {

using training::SessionKind;

constexpr double kDayMs = 86400e3;

struct KindWords {
  SessionKind kind;
  const char* name;
  const char* line;
};
/// Labels on the screen, in English.
constexpr std::array<KindWords, 9> kKindWords = {{
    {SessionKind::pre_test, toTranslate("Test before practice"),
     toTranslate("How small a change you can feel now, without feedback.")},
    {SessionKind::practice, toTranslate("Practice"), toTranslate("After each answer you hear whether it was right.")},
    {SessionKind::mastery, toTranslate("Mastery"),
     toTranslate("Step by step to smaller changes, three of four right.")},
    {SessionKind::post_test, toTranslate("Test after practice"),
     toTranslate("The same test again, to see what has changed.")},
    {SessionKind::exam, toTranslate("Examination"), toTranslate("Pass, not yet, or repeat, without feedback.")},
    {SessionKind::retention, toTranslate("Retention test"), toTranslate("A week or more after the last test.")},
    {SessionKind::lump, toTranslate("Lumps"), toTranslate("Is there a lump, where, and of which kind?")},
    {SessionKind::lump_exam, toTranslate("Examination with lumps"),
     toTranslate("Find 18 lumps in six bodies, without feedback.")},
    {SessionKind::free, toTranslate("Free exploration"), toTranslate("Feel whatever you like. Nothing is asked.")},
}};

/// End of the newest test whose result could fade; 0: none.
std::int64_t lastTestMs(const TrainingPast& past) {
  return std::max(past.of(SessionKind::post_test).last_ms, past.of(SessionKind::exam).last_ms);
}

/// Whole days left until retention can be tested.
int daysToWait(const TrainingPast& past, const training::Protocol& protocol, std::int64_t now_ms) {
  const double since_days = static_cast<double>(now_ms - lastTestMs(past)) / kDayMs;
  return std::max(0, static_cast<int>(std::ceil(protocol.least_days_to_retention - since_days)));
}

SessionKind suggestion(const TrainingPast& past, bool retention_due) {
  for (const KindWords& words : kKindWords) {
    if (words.kind == SessionKind::free || training::hidesLumps(words.kind)) continue;
    if (past.of(words.kind).interrupted) return words.kind;
  }
  if (past.of(SessionKind::pre_test).finished == 0) return SessionKind::pre_test;
  if (retention_due && past.of(SessionKind::retention).finished == 0) return SessionKind::retention;
  const int practices = past.of(SessionKind::practice).finished + past.of(SessionKind::mastery).finished;
  if (practices < kPracticesOfCourse) return SessionKind::practice;
  if (past.of(SessionKind::post_test).finished == 0) return SessionKind::post_test;
  if (past.of(SessionKind::exam).finished == 0) return SessionKind::exam;
  return SessionKind::practice;
}

std::string retentionDueText(const TrainingPast& past, int days) {
  if (lastTestMs(past) == 0) return tr("After the test after practice, or an examination.");
  return trnf("Tomorrow: a week after the last test.", "In {} days: a week after the last test.",
              static_cast<std::size_t>(days), days);
}

}  // namespace

TrainingPast::OfKind TrainingPast::of(SessionKind kind) const {
  const auto found = kinds.find(kind);
  return found == kinds.end() ? OfKind{} : found->second;
}

std::string nameOfKind(SessionKind kind) {
  const auto found = std::ranges::find(kKindWords, kind, &KindWords::kind);
  return tr(found->name);
}

TrainingPast loadTrainingPast(training::Store& store, const std::string& trainee) {
  TrainingPast past;
  for (const training::SessionRow& session : store.sessions(trainee)) {
    TrainingPast::OfKind& of = past.kinds[session.kind];
    for (const training::BlockRow& block : store.blocks(session.id)) {
      if (!block.finished) continue;
      ++of.finished;
      of.last_ms = std::max(of.last_ms, session.end_ms);
    }
  }
  for (auto& [kind, of] : past.kinds) of.interrupted = store.interrupted(trainee, kind).has_value();
  return past;
}

std::vector<Offer> offersFor(const TrainingPast& past, const training::Protocol& protocol, std::int64_t now_ms) {
  const bool tested = lastTestMs(past) > 0;
  const int days = daysToWait(past, protocol, now_ms);
  const SessionKind suggested = suggestion(past, tested && days == 0);
  std::vector<Offer> offers;
  for (const KindWords& words : kKindWords) {
    if (training::hidesLumps(words.kind) && !protocol.lump) continue;
    Offer offer{words.kind, tr(words.name), tr(words.line), true, words.kind == suggested};
    if (words.kind == SessionKind::retention && (!tested || days > 0)) {
      offer.enabled = false;
      offer.line = retentionDueText(past, days);
    }
    if (past.of(words.kind).interrupted && words.kind != SessionKind::free) {
      offer.enabled = true;
      offer.line = tr("Continues where it stopped.");
    }
    offers.push_back(std::move(offer));
  }
  return offers;
}

}  // namespace palpate::viewer
