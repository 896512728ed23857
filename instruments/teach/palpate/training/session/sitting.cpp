#include "palpate/training/session/sitting.h"

#include <algorithm>

#include "palpate/base/hash.h"
#include "palpate/training/records/trainee_code.h"

namespace palpate::training {

std::uint64_t mixedSeed(std::uint64_t seed, std::string_view word) {
  Hash hash;
  hash.add(seed);
  for (const char letter : word) hash.add(static_cast<std::uint64_t>(static_cast<unsigned char>(letter)));
  return hash.value();
}

SittingState::SittingState(const SessionPlan& the_plan, const Moment& now)
    : plan(the_plan), ids(mixedSeed(the_plan.seed, the_plan.row.id)), watch(the_plan.tick_s), begun(now) {
  plan.row.kind = plan.kind;
  plan.row.rng_seed = plan.seed;
  plan.row.start_ms = now.utc_ms;
  recordSession(0);
}

void SittingState::say(std::string text) { said = {.text = std::move(text), .number = said.number + 1}; }

Uuid SittingState::newId(const Moment& now) {
  const std::uint64_t first = ids.bits();
  return makeUuidV7(now.utc_ms, {first, ids.bits()});
}

void SittingState::recordEvent(std::string kind, std::string text, const Moment& now) {
  rows.emplace_back(EventRow{.id = newId(now),
                             .session_id = plan.row.id,
                             .at_ms = now.utc_ms,
                             .kind = std::move(kind),
                             .text = std::move(text)});
}

void SittingState::recordSession(std::int64_t end_ms) {
  plan.row.end_ms = end_ms;
  rows.emplace_back(plan.row);
}

BlockRow SittingState::newBlockRow(int number, Method method, ChangeMeaning meaning, const Moment& now) {
  return {.id = newId(now),
          .session_id = plan.row.id,
          .number = number,
          .method = method,
          .change_meaning = meaning,
          .protocol_id = plan.protocol.id,
          .protocol_version = plan.protocol.version};
}

TrialRow SittingState::newTrialRow(int number, const Moment& now) {
  TrialRow row{.id = newId(now),
               .block_id = block_row.id,
               .session_id = plan.row.id,
               .number = number,
               .start_ms = begun.utc_ms,
               .end_ms = now.utc_ms,
               .seconds = elapsed(now)};
  row.file_tick_first = begun.tick;
  row.file_tick_last = now.tick;
  watch.writeTo(row);
  return row;
}

void SittingState::startClock(const Moment& now) {
  begun = now;
  paused_s = 0.0;
  watch.restart();
}

double SittingState::elapsed(const Moment& now) const {
  const double paused_now = paused_since ? now.s - paused_since->s : 0.0;
  return std::max(0.0, now.s - begun.s - paused_s - paused_now);
}

void SittingState::finish(const Moment& now) {
  screen = Screen::finished;
  recordSession(now.utc_ms);
  say(goodbye(!block_row.id.empty() && !block_row.finished));
}

std::string Sitting::screenWord() const { return std::string(wordFor(screen())); }

void Sitting::pause(const Moment& now) {
  if (paused() || screen() == Screen::finished) return;
  state_->paused_since = now;
  state_->recordEvent("pause", screenWord(), now);
  state_->say(pausedNotice());
}

void Sitting::goOn(const Moment& now) {
  if (!paused()) return;
  state_->paused_s += now.s - state_->paused_since->s;
  state_->paused_since.reset();
  state_->recordEvent("resume", screenWord(), now);
  state_->say(state_->sentence());
}

void Sitting::leave(const Moment& now) {
  if (screen() == Screen::finished) return;
  state_->recordEvent("leave", screenWord(), now);
  state_->paused_since.reset();
  state_->finish(now);
}

}  // namespace palpate::training
