#include "palpate/training/session/lump_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/training/wording.h"

namespace palpate::training {

namespace {

using lumps::LumpQuestion;

lumps::LumpBlockSettings blockSettings(const SessionPlan& plan) {
  return {.task = plan.bodies->task(),
          .exam = plan.kind == SessionKind::lump_exam,
          .places = plan.bodies->places(),
          .cue_of = [bodies = plan.bodies](const lumps::HiddenLump& lump) { return bodies->computeClarity(lump); }};
}

lumps::LumpBlock blockOf(const SessionPlan& plan) {
  if (!hidesLumps(plan.kind)) throw Error("lump session: expected the kind lump or lump_exam");
  if (plan.resumed) return lumps::LumpBlock::resumed(blockSettings(plan), plan.resumed->state_json);
  return {blockSettings(plan), mixedSeed(plan.seed, "lumps")};
}

double plainest(const lumps::LumpTrial& trial) {
  double cue = 0.0;
  for (const lumps::HiddenLump& lump : trial.hidden) cue = std::max(cue, lump.cue);
  return cue;
}

}  // namespace

struct LumpSession::Impl final : SittingState {
  lumps::LumpBlock block;

  Impl(const SessionPlan& the_plan, const Moment& now) : SittingState(the_plan, now), block(blockOf(plan)) {}

  bool exam() const { return block.settings().exam; }
  /// A question that can be answered now.
  bool canAnswer() const { return screen == Screen::trial && !paused_since; }
  std::string sentence() const override {
    return lumpQuestionText(block.question(), exam(), block.trial().findings.size());
  }

  void open(const Moment& now) {
    if (plan.resumed) {
      block_row = *plan.resumed;
      recordEvent("resume", fmt::format("block {}", block_row.number), now);
    } else {
      block_row = newBlockRow(1, exam() ? Method::constant_levels : Method::two_down_one_up, ChangeMeaning::cue, now);
    }
    recordBlock();
    say(lumpInstruction(exam()));
  }

  /// After every answer.
  void recordBlock() {
    const lumps::LumpCounts counts = block.counts();
    block_row.state_json = block.state();
    block_row.finished = block.finished();
    block_row.trials = counts.bodies;
    block_row.threshold = counts.threshold.median;
    block_row.threshold_low = counts.threshold.low;
    block_row.threshold_high = counts.threshold.high;
    if (exam() && block_row.finished) block_row.verdict = counts.passed ? Verdict::pass : Verdict::not_yet;
    rows.emplace_back(block_row);
  }

  void recordTrial(const Moment& now) {
    const lumps::LumpTrial& body = block.trial();
    TrialRow row = newTrialRow(block.number(), now);
    row.change = plainest(body);
    row.correct = isRight(body, block.settings().task);
    row.timed_out = body.timed_out;
    row.lumps = lumps::lumpTrialText(body);
    trials.push_back(row);
    rows.emplace_back(std::move(row));
  }

  void begin(const Moment& now) {
    screen = Screen::trial;
    startClock(now);
    say(sentence());
  }

  bool advanceIfAccepted(bool taken, const Moment& now) {
    if (!taken) return false;
    if (!block.trial().over) {
      recordBlock();
      say(sentence());
      return true;
    }
    recordTrial(now);
    if (!exam()) {
      recordBlock();
      screen = Screen::feedback;
      say(lumpFeedback(block.trial(), block.settings().task, plan.sites));
    } else {
      proceed(now);
    }
    return true;
  }

  /// Goes to the next body. An examination's answer is stored with it, so that the same body is never felt twice.
  void proceed(const Moment& now) {
    block.next();
    recordBlock();
    if (!block.finished()) return begin(now);
    screen = Screen::block_summary;
    say(lumpSummary(block.counts(), exam()));
    recordEvent("block", fmt::format("{} finished", block_row.number), now);
  }
};

LumpSession::LumpSession(const SessionPlan& plan, const Moment& now)
    : Sitting(std::make_unique<Impl>(plan, now)), impl_(static_cast<Impl&>(*state_)) {
  impl_.open(now);
}

/// Records had this word before all sessions had the same screens.
std::string LumpSession::screenWord() const {
  return screen() == Screen::block_summary ? "summary" : Sitting::screenWord();
}

LumpQuestion LumpSession::question() const {
  return screen() == Screen::trial ? impl_.block.question() : LumpQuestion::none;
}

std::vector<lumps::HiddenLump> LumpSession::hidden() const {
  const bool felt = screen() == Screen::trial || screen() == Screen::feedback;
  return felt && !paused() ? impl_.block.trial().hidden : std::vector<lumps::HiddenLump>();
}

std::vector<lumps::HiddenLump> LumpSession::shown() const {
  const bool told = screen() == Screen::feedback && !isExam();
  return told ? impl_.block.trial().hidden : std::vector<lumps::HiddenLump>();
}

std::vector<lumps::LumpFinding> LumpSession::named() const {
  const bool of_body = screen() == Screen::trial || screen() == Screen::feedback;
  return of_body ? impl_.block.trial().findings : std::vector<lumps::LumpFinding>();
}

bool LumpSession::padShown() const {
  if (isExam() || paused()) return false;
  if (screen() == Screen::trial) return impl_.block.settings().task.pad_shown;
  return screen() == Screen::feedback;
}

int LumpSession::bodyNumber() const { return impl_.block.number(); }
int LumpSession::bodiesAtMost() const { return impl_.block.bodies(); }
bool LumpSession::isExam() const { return impl_.exam(); }

void LumpSession::ready(const Moment& now) {
  if (!impl_.canAnswer()) return;
  impl_.startClock(now);
}

void LumpSession::feel(const trace::Sample& sample, const Moment& /*now*/) {
  if (screen() == Screen::trial && !paused()) impl_.watch.follow(sample);
}

void LumpSession::next(const Moment& now) {
  if (paused()) return goOn(now);
  switch (screen()) {
    case Screen::instruction:
      // A body that was finished before the interruption is not asked about again.
      return impl_.block.trial().over ? impl_.proceed(now) : impl_.begin(now);
    case Screen::feedback:
      return impl_.proceed(now);
    case Screen::block_summary:
      return impl_.finish(now);
    default:
      return;
  }
}

bool LumpSession::answer(int choice, const Moment& now) {
  return impl_.canAnswer() && impl_.advanceIfAccepted(impl_.block.answer(choice), now);
}

bool LumpSession::answer(const Vec2& place_mm, const Moment& now) {
  return impl_.canAnswer() && impl_.advanceIfAccepted(impl_.block.answer(place_mm), now);
}

bool LumpSession::noMore(const Moment& now) {
  return impl_.canAnswer() && impl_.advanceIfAccepted(impl_.block.noMore(), now);
}

void LumpSession::pause(const Moment& now) {
  if (impl_.canAnswer()) Sitting::pause(now);
}

lumps::LumpCounts LumpSession::counts() const { return impl_.block.counts(); }

}  // namespace palpate::training
