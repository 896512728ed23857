#include "palpate/training/trainee/lump_trainee.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace palpate::training {

namespace {

/// To make up its mind about a body.
constexpr double kDecideS = 1.5;
/// SD between named and intended place, mm, along each axis.
constexpr double kNamedBesideSdMm = 3.0;

}  // namespace

LumpRun::LumpRun(LumpSession& session, BodyTouch& touch, const TraineeOrders& orders, std::int64_t start_ms)
    : SittingRun(session, touch, orders, start_ms, orders.lump_observer.seed), session_(session), touch_(touch) {
  skill_ = lumps::drawSkill(orders_.lump_observer, random_);
  // The same person, another day: later draws depend on the session.
  random_ = Random(random_.bits() ^ session.plan().seed);
}

void LumpRun::walkScreen() {
  if (session_.screen() == Screen::trial) return tryBody();
  // A session is one block: reads the text and continues.
  touch_.rest(kDecideS, [](const trace::Sample&) {});
  session_.next(now());
}

void LumpRun::tryBody() {
  touch_.mark(fmt::format("body {}", session_.bodyNumber()));
  touch_.exchangeWorld(session_.plan().bodies->with(session_.hidden()));
  session_.ready(now());
  const std::size_t before = session_.trials().size();
  const std::vector<lumps::HiddenLump> hidden = session_.hidden();
  const FeltLump last_named{.truth = hidden.empty() ? lumps::HiddenLump() : hidden.back(), .clarity = 1.0};
  const std::vector<FeltLump> found = searchForLumps(hidden);
  touch_.rest(kDecideS, [&](const trace::Sample& sample) { session_.feel(sample, now()); });
  describe(last_named);  // an interrupted session continues with the last question
  if (session_.question() == lumps::LumpQuestion::there) {
    session_.answer(found.empty() ? 0 : 1, now());
    storeNewRows();
  }
  for (const FeltLump& lump : found) answerPlace(lump);
  if (!session_.isExam()) answerPlace(last_named);
  session_.noMore(now());
  storeNewRows();
  ++answers_;
  if (orders_.answered && session_.trials().size() > before) orders_.answered(session_.trials().back());
}

void LumpRun::answerPlace(const FeltLump& lump) {
  if (session_.question() != lumps::LumpQuestion::place) return;
  session_.answer(lump.named_mm, now());
  storeNewRows();
  describe(lump);
}

bool LumpRun::isNamed(const lumps::HiddenLump& lump) const {
  const std::vector<lumps::LumpFinding> named = session_.named();
  const double near_mm = session_.plan().bodies->task().hitMm(lump.size);
  return std::ranges::any_of(named, [&](const lumps::LumpFinding& finding) {
    return finding.place_mm && (*finding.place_mm - lump.place_mm).norm() <= near_mm;
  });
}

std::vector<LumpRun::FeltLump> LumpRun::searchForLumps(const std::vector<lumps::HiddenLump>& hidden) {
  std::vector<FeltLump> found;
  for (const lumps::HiddenLump& lump : hidden) {
    if (isNamed(lump)) continue;
    FeltLump felt = feel(lump);
    if (lumps::finds(felt.clarity, skill_, orders_.lump_observer, random_)) found.push_back(std::move(felt));
  }
  const std::vector<Vec2>& places = session_.plan().bodies->places();
  const Vec2 anywhere = places[random_.below(places.size())];
  if (hidden.empty()) press(anywhere, nullptr);
  if (random_.uniform() < orders_.lump_observer.false_alarms && (session_.isExam() || found.empty())) {
    found.push_back({.truth = {}, .clarity = 0.0, .named_mm = anywhere});
  }
  return found;
}

LumpRun::FeltLump LumpRun::feel(const lumps::HiddenLump& lump) {
  const Vec2 stroke = lump.place_mm + Vec2(lumps::drawStroke(random_), 0.0);
  contact::FingerOutput firmest;
  press(stroke, &firmest);
  const lumps::LumpCue cue = lumps::computeCue(firmest, touch_.world().surface.lumps.get(),
                                               session_.plan().bodies->ground(), orders_.lump_observer.taxels);
  const Vec2 seems = orders_.lump_observer.field ? lump.place_mm : stroke;
  return {.truth = lump,
          .clarity = lumps::computeClarity(cue, orders_.lump_observer),
          .named_mm = seems + kNamedBesideSdMm * random_.normal2()};
}

void LumpRun::press(const Vec2& place_mm, contact::FingerOutput* firmest) {
  Site place;
  place.place_mm = place_mm;
  const MeantPress meant{.force_n = orders_.lump_observer.press_n, .hold_s = orders_.lump_observer.press_s};
  double most_n = 0.0;
  touch_.press(place, meant, [&](const trace::Sample& sample) {
    session_.feel(sample, now());
    const double force_n = sample.contact.force.dot(sample.contact.normal);
    if (firmest == nullptr || force_n <= most_n) return;
    most_n = force_n;
    *firmest = sample.contact;
  });
}

void LumpRun::describe(const FeltLump& lump) {
  using lumps::LumpQuestion;
  constexpr std::array kNoKind = {LumpQuestion::there, LumpQuestion::place, LumpQuestion::none};
  for (LumpQuestion asked = session_.question(); std::ranges::find(kNoKind, asked) == kNoKind.end();
       asked = session_.question()) {
    const int truth = asked == LumpQuestion::size       ? lump.truth.size
                      : asked == LumpQuestion::depth    ? lump.truth.depth
                      : asked == LumpQuestion::hardness ? lump.truth.hardness
                                                        : (lump.truth.mobile ? 1 : 0);
    session_.answer(drawAnswer(truth, asked == LumpQuestion::mobile ? 2 : lumps::kGrades, lump.clarity), now());
    storeNewRows();
  }
}

int LumpRun::drawAnswer(int truth, int choices, double clarity) {
  const bool knows = random_.uniform() < lumps::detectionProbability(clarity, orders_.lump_observer);
  const auto any = static_cast<int>(random_.below(static_cast<std::uint64_t>(choices)));
  return knows ? truth : any;
}

}  // namespace palpate::training
