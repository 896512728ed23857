#include "palpate/training/session/lump_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/hash.h"
#include "palpate/base/random.h"
#include "palpate/training/records/trainee_code.h"
#include "palpate/training/session/trial_scene.h"
#include "palpate/training/wording.h"

namespace palpate::training {

namespace {

using lumps::LumpQuestion;

std::uint64_t lumpSeed(const LumpSessionPlan& plan, std::string_view what) {
  Hash hash;
  hash.add(plan.seed);
  for (const char letter : what) hash.add(static_cast<std::uint64_t>(static_cast<unsigned char>(letter)));
  return hash.value();
}

lumps::LumpBlockSettings blockSettings(const LumpSessionPlan& plan) {
  return {.task = plan.bodies->task(),
          .exam = plan.kind == SessionKind::lump_exam,
          .places = plan.bodies->places(),
          .cue_of = [bodies = plan.bodies](const lumps::HiddenLump& lump) { return bodies->computeClarity(lump); }};
}

lumps::LumpBlock blockOf(const LumpSessionPlan& plan) {
  if (!hidesLumps(plan.kind)) throw Error("lump session: expected the kind lump or lump_exam");
  if (plan.resumed) return lumps::LumpBlock::resumed(blockSettings(plan), plan.resumed->state_json);
  return {blockSettings(plan), lumpSeed(plan, "lumps")};
}

double plainest(const lumps::LumpTrial& trial) {
  double cue = 0.0;
  for (const lumps::HiddenLump& lump : trial.hidden) cue = std::max(cue, lump.cue);
  return cue;
}

}  // namespace

struct LumpSession::Impl {
  LumpSessionPlan plan;
  Random ids;
  lumps::LumpBlock block;
  LumpScreen screen = LumpScreen::instruction;
  Said said;
  TrialWatch watch;
  BlockRow block_row;
  std::vector<TrialRow> trials;
  std::vector<Row> rows;
  Moment begun;  // current body's start
  std::optional<Moment> paused_since;

  Impl(const LumpSessionPlan& wanted, const Moment& now)
      : plan(wanted), ids(lumpSeed(wanted, wanted.row.id)), block(blockOf(wanted)), watch(wanted.tick_s), begun(now) {}

  bool exam() const { return block.settings().exam; }
  /// A question that can be answered now.
  bool canAnswer() const { return screen == LumpScreen::trial && !paused_since; }

  void say(std::string text) { said = {.text = std::move(text), .number = said.number + 1}; }

  Uuid newId(const Moment& now) {
    std::array<std::uint64_t, 2> chance{};
    for (std::uint64_t& part : chance) part = ids.bits();
    return makeUuidV7(now.utc_ms, {chance[0], chance[1]});
  }

  void note(const char* kind, std::string text, const Moment& now) {
    EventRow event;
    event.id = newId(now);
    event.session_id = plan.row.id;
    event.kind = kind;
    event.text = std::move(text);
    event.at_ms = now.utc_ms;
    rows.emplace_back(std::move(event));
  }

  void open(const Moment& now) {
    SessionRow& row = plan.row;
    row.kind = plan.kind;
    row.rng_seed = plan.seed;
    row.start_ms = now.utc_ms;
    row.end_ms = 0;
    rows.emplace_back(row);
    if (plan.resumed) {
      block_row = *plan.resumed;
      note("resume", fmt::format("block {}", block_row.number), now);
    } else {
      block_row.id = newId(now);
      block_row.session_id = row.id;
      block_row.method = exam() ? Method::constant_levels : Method::two_down_one_up;
      block_row.change_meaning = ChangeMeaning::cue;
      block_row.protocol_id = plan.protocol.id;
      block_row.protocol_version = plan.protocol.version;
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
    TrialRow row;
    row.id = newId(now);
    row.block_id = block_row.id;
    row.session_id = plan.row.id;
    row.number = block.number();
    row.start_ms = begun.utc_ms;
    row.end_ms = now.utc_ms;
    row.seconds = std::max(0.0, now.s - begun.s);
    row.file_tick_first = begun.tick;
    row.file_tick_last = now.tick;
    row.change = plainest(body);
    row.correct = isRight(body, block.settings().task);
    row.timed_out = body.timed_out;
    row.lumps = lumps::lumpTrialText(body);
    watch.writeTo(row);
    trials.push_back(row);
    rows.emplace_back(std::move(row));
  }

  void begin(const Moment& now) {
    screen = LumpScreen::trial;
    begun = now;
    watch.restart();
    ask();
  }

  void ask() { say(lumpQuestionText(block.question(), exam(), block.trial().findings.size())); }

  bool advanceIfAccepted(bool taken, const Moment& now) {
    if (!taken) return false;
    if (!block.trial().over) {
      recordBlock();
      ask();
      return true;
    }
    recordTrial(now);
    if (!exam()) {
      recordBlock();
      screen = LumpScreen::feedback;
      say(lumpFeedback(block.trial(), block.settings().task, plan.sites));
    } else {
      goOn(now);
    }
    return true;
  }

  /// Goes to the next body. An examination's answer is stored with it, so that the same body is never felt twice.
  void goOn(const Moment& now) {
    block.next();
    recordBlock();
    if (!block.finished()) return begin(now);
    screen = LumpScreen::summary;
    say(lumpSummary(block.counts(), exam()));
    note("block", fmt::format("{} finished", block_row.number), now);
  }

  void finish(const Moment& now) {
    screen = LumpScreen::finished;
    plan.row.end_ms = now.utc_ms;
    rows.emplace_back(plan.row);
    say(goodbye(!block.finished()));
  }
};

LumpSession::LumpSession(const LumpSessionPlan& plan, const Moment& now) : impl_(std::make_unique<Impl>(plan, now)) {
  impl_->open(now);
}

LumpSession::~LumpSession() = default;

LumpScreen LumpSession::screen() const { return impl_->screen; }
Said LumpSession::said() const { return impl_->said; }

LumpQuestion LumpSession::question() const {
  return screen() == LumpScreen::trial ? impl_->block.question() : LumpQuestion::none;
}

std::vector<lumps::HiddenLump> LumpSession::hidden() const {
  const bool felt = screen() == LumpScreen::trial || screen() == LumpScreen::feedback;
  return felt && !paused() ? impl_->block.trial().hidden : std::vector<lumps::HiddenLump>();
}

std::vector<lumps::HiddenLump> LumpSession::shown() const {
  const bool told = screen() == LumpScreen::feedback && !isExam();
  return told ? impl_->block.trial().hidden : std::vector<lumps::HiddenLump>();
}

std::vector<lumps::LumpFinding> LumpSession::named() const {
  const bool of_body = screen() == LumpScreen::trial || screen() == LumpScreen::feedback;
  return of_body ? impl_->block.trial().findings : std::vector<lumps::LumpFinding>();
}

bool LumpSession::padShown() const {
  if (isExam() || paused()) return false;
  if (screen() == LumpScreen::trial) return impl_->block.settings().task.pad_shown;
  return screen() == LumpScreen::feedback;
}

int LumpSession::bodyNumber() const { return impl_->block.number(); }
int LumpSession::bodiesAtMost() const { return impl_->block.bodies(); }
bool LumpSession::isExam() const { return impl_->exam(); }

void LumpSession::ready(const Moment& now) {
  if (!impl_->canAnswer()) return;
  impl_->begun = now;
  impl_->watch.restart();
}

void LumpSession::feel(const trace::Sample& sample, const Moment& /*now*/) {
  if (screen() == LumpScreen::trial && !paused()) impl_->watch.follow(sample);
}

void LumpSession::next(const Moment& now) {
  if (paused()) return goOn(now);
  switch (screen()) {
    case LumpScreen::instruction:
      // A body that was finished before the interruption is not asked about again.
      return impl_->block.trial().over ? impl_->goOn(now) : impl_->begin(now);
    case LumpScreen::feedback:
      return impl_->goOn(now);
    case LumpScreen::summary:
      return impl_->finish(now);
    case LumpScreen::trial:
    case LumpScreen::finished:
      return;
  }
}

bool LumpSession::answer(int choice, const Moment& now) {
  return impl_->canAnswer() && impl_->advanceIfAccepted(impl_->block.answer(choice), now);
}

bool LumpSession::answer(const Vec2& place_mm, const Moment& now) {
  return impl_->canAnswer() && impl_->advanceIfAccepted(impl_->block.answer(place_mm), now);
}

bool LumpSession::noMore(const Moment& now) {
  return impl_->canAnswer() && impl_->advanceIfAccepted(impl_->block.noMore(), now);
}

void LumpSession::pause(const Moment& now) {
  if (!impl_->canAnswer()) return;
  impl_->paused_since = now;
  impl_->note("pause", std::string(wordFor(screen())), now);
  impl_->say(pausedNotice());
}

void LumpSession::goOn(const Moment& now) {
  if (!paused()) return;
  impl_->begun.s += now.s - impl_->paused_since->s;
  impl_->paused_since.reset();
  impl_->note("resume", std::string(wordFor(screen())), now);
  impl_->ask();
}

bool LumpSession::paused() const { return impl_->paused_since.has_value(); }

void LumpSession::leave(const Moment& now) {
  if (screen() == LumpScreen::finished) return;
  impl_->paused_since.reset();
  impl_->note("leave", std::string(wordFor(screen())), now);
  impl_->finish(now);
}

const LumpSessionPlan& LumpSession::plan() const { return impl_->plan; }
const std::vector<TrialRow>& LumpSession::trials() const { return impl_->trials; }
lumps::LumpCounts LumpSession::counts() const { return impl_->block.counts(); }
std::vector<Row> LumpSession::drainRows() { return std::exchange(impl_->rows, {}); }

}  // namespace palpate::training
