#include "palpate/training/session/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/hash.h"
#include "palpate/base/random.h"
#include "palpate/training/session/trial_scene.h"

namespace palpate::training {

namespace {

/// The place that familiarisation shows first, if it exists: in the middle of the left side.
constexpr int kFamiliarSite = 4;
/// Draws of familiarisation are those of no block: blocks count from 1.
constexpr int kFamiliarDraws = -1;
constexpr double kSecondsAMinute = 60.0;

/// The place that a stiffer one is compared with: opposite it, or the next.
int comparedWith(const SiteSet& sites, int number) {
  const Site& stiff = *sites.numbered(number);
  for (const Site& site : sites.sites) {
    if (site.level == stiff.level && site.number != number) return site.number;
  }
  return number < sites.choices() ? number + 1 : number - 1;
}

/// Another block of the same session draws other sites.
std::uint64_t blockSeed(const SessionPlan& plan, int number) {
  Hash hash;
  hash.add(plan.seed);
  hash.add(static_cast<std::uint64_t>(number));
  return hash.value();
}

}  // namespace

ProtocolRow makeProtocolRow(const Protocol& protocol) {
  return {.id = protocol.id,
          .version = protocol.version,
          .text = protocolText(protocol),
          .sha256 = protocolSha256(protocol)};
}

struct Session::Impl final : SittingState {
  const SessionSettings& settings;
  Exploration exploration;
  std::optional<Block> block;
  Moment started;       // the session
  bool warned = false;  // about places not pressed, in this trial
  bool device_works = false;
  bool break_offered = false;
  std::optional<BlockResult> result;
  HiddenNow answered;  // place that feedback reveals
  FamiliarPlaces familiar;
  int familiar_stiffer = 0;  // in the current body, whether shown or requested
  Random familiar_draws;

  Impl(const SessionPlan& the_plan, const Moment& now)
      : SittingState(the_plan, now),
        settings(settingsOf(plan.protocol, plan.kind)),
        exploration(plan.sites, plan.protocol.exploration, plan.tick_s),
        started(now),
        familiar_draws(blockSeed(plan, kFamiliarDraws)) {}

  std::string sentence() const override { return screen == Screen::trial ? instruction(plan.protocol, plan.kind) : ""; }

  // --- screens

  void open(const Moment& now) {
    if (!settings.natural_stiffness) recordEvent("tissue", fmt::format("{:g} N/mm", plan.protocol.base_n_per_mm), now);
    if (plan.kind != SessionKind::free) resumeOrBeginBlock(now);
    if (!plan.familiar) {
      screen = Screen::device_check;
      return say(deviceCheck(false));
    }
    introduce(now);
  }

  void resumeOrBeginBlock(const Moment& now) {
    if (plan.resumed) {
      block_row = *plan.resumed;
      block = Block::resumed(settings.block, block_row.state_json);
      plan.resumed.reset();
      recordEvent("resume", fmt::format("block {}", block_row.number), now);
    } else {
      beginBlock(1, now);
    }
  }

  void beginBlock(int number, const Moment& now) {
    block = Block(settings.block, blockSeed(plan, number));
    trials.clear();
    result.reset();
    block_row = newBlockRow(number, settings.block.method, settings.block.meaning, now);
    block_row.state_json = block->state();
    rows.emplace_back(block_row);
  }

  // --- familiarisation: shown, requested, shown again where the answer was wrong

  const Site& site(int number) const { return *plan.sites.numbered(number); }
  int familiarOther() const { return familiar.first + familiar.second - familiar_stiffer; }

  void familiarise() {
    screen = Screen::familiarisation;
    familiar.first = std::min(kFamiliarSite, plan.sites.choices());
    familiar.second = comparedWith(plan.sites, familiar.first);
    familiar_stiffer = familiar.first;
    showFamiliar(familiarisation(site(familiar_stiffer), site(familiarOther())));
  }

  void showFamiliar(std::string words) {
    familiar.stiffer = familiar_stiffer;
    warned = false;
    exploration.restart();
    say(std::move(words));
  }

  void askFamiliar() {
    const bool both = exploration.visited(familiar.first) && exploration.visited(familiar.second);
    if (!both && !std::exchange(warned, true)) return say(feelBoth());
    familiar.stiffer = 0;
    ++familiar.round;
    familiar_stiffer = familiar_draws.below(2) == 0 ? familiar.first : familiar.second;
    exploration.restart();
    say(stifferQuestion());
  }

  bool answerFamiliar(int answer, const Moment& now) {
    if (answer != familiar.first && answer != familiar.second) return false;
    if (answer != familiar_stiffer) {
      showFamiliar(familiarFeedback(site(familiar_stiffer)));
      return true;
    }
    recordEvent("familiarisation", fmt::format("found at answer {}", familiar.round), now);
    introduce(now);
    return true;
  }

  void introduce(const Moment& now) {
    if (plan.kind == SessionKind::free) {
      screen = Screen::free_exploration;
      exploration.restart();
      return say(instruction(plan.protocol, plan.kind));
    }
    if (block->finished()) return summarise(now);
    screen = Screen::instruction;
    say(instruction(plan.protocol, plan.kind));
  }

  void beginTrial(const Moment& now) {
    screen = Screen::trial;
    warned = false;
    paused_since.reset();
    restart(now);
  }
  void restart(const Moment& now) {
    startClock(now);
    exploration.restart();
  }

  // --- answers

  TrialRow makeTrialRow(const TrialOutcome& outcome, const Moment& now) {
    const PlannedTrial& planned = block->next();
    TrialRow row = newTrialRow(planned.number, now);
    row.kind = planned.kind;
    row.change = planned.change;
    row.site_true = planned.site;
    row.site_answer = outcome.answer;
    row.correct = outcome.correct;
    row.timed_out = outcome.answer == 0;
    row.excluded = outcome.target_visited ? "" : "target not felt";
    row.sites_felt = outcome.visited;
    row.visits = exploration.visits();
    return row;
  }

  void recordAnswer(int answer, const Moment& now) {
    const PlannedTrial planned = block->next();
    const TrialOutcome outcome{.answer = answer,
                               .correct = answer == planned.site,
                               .visited = exploration.visitedSites(),
                               .target_visited = exploration.visited(planned.site)};
    trials.push_back(makeTrialRow(outcome, now));
    rows.emplace_back(trials.back());
    if (settings.all_sites && outcome.visited < plan.sites.choices()) {
      recordEvent("warning",
                  fmt::format("trial {}: {} sites not felt", planned.number, plan.sites.choices() - outcome.visited),
                  now);
    }
    block->answer(outcome);
    recordBlock();
    const Site& truth = *plan.sites.numbered(planned.site);
    announceOutcome(outcome, truth);
    if (settings.feedback) {
      screen = Screen::feedback;
      answered = {.site = planned.site, .change = planned.change};
    } else {
      proceedAfterAnswer(now);
    }
  }

  void announceOutcome(const TrialOutcome& outcome, const Site& truth) {
    if (outcome.answer == 0) return say(timeIsUp(settings.feedback, truth));
    if (!settings.feedback) return say(answerSaved());
    say(outcome.correct ? rightAnswer(truth) : wrongAnswer(truth));
  }

  void proceedAfterAnswer(const Moment& now) {
    if (block->finished()) return summarise(now);
    offerBreak(now);
    beginTrial(now);
  }

  void offerBreak(const Moment& now) {
    const double after_s = kSecondsAMinute * plan.protocol.break_after_min;
    if (break_offered || after_s <= 0.0 || now.s - started.s < after_s) return;
    break_offered = true;
    say(said.text + " " + breakOfferText());
    recordEvent("break", "offered", now);
  }

  void recordBlock() {
    block_row.copyStateFrom(*block);
    rows.emplace_back(block_row);
  }

  void summarise(const Moment& now) {
    screen = Screen::block_summary;
    result = block->result();
    say(blockSummary(*result, plan.kind, plan.before));
    recordEvent("block", fmt::format("{} finished", block_row.number), now);
  }

  bool measures() const { return !settings.feedback; }

  /// Practice continues with another block; a test has one.
  void afterSummary(const Moment& now) {
    if (measures()) return finish(now);
    beginBlock(block_row.number + 1, now);
    introduce(now);
  }
};

Session::Session(const SessionPlan& plan, const Moment& now)
    : Sitting(std::make_unique<Impl>(plan, now)), impl_(static_cast<Impl&>(*state_)) {
  const int choices = impl_.settings.block.choices;
  if (plan.kind != SessionKind::free && choices != plan.sites.choices()) {
    throw Error(fmt::format("session: the protocol asks for {} sites, the body has {}", choices, plan.sites.choices()));
  }
  impl_.open(now);
}

std::optional<HiddenNow> Session::hidden() const {
  switch (impl_.screen) {
    case Screen::familiarisation:
      return HiddenNow{.site = impl_.familiar_stiffer, .change = largestChange(impl_.settings.block)};
    case Screen::trial:
      return HiddenNow{.site = impl_.block->next().site, .change = impl_.block->next().change};
    case Screen::feedback:
      return impl_.answered;
    default:
      return std::nullopt;
  }
}

bool Session::feelsTruth() const {
  const auto places = familiarPlaces();
  return impl_.screen == Screen::feedback || (places && places->stiffer != 0);
}

std::optional<FamiliarPlaces> Session::familiarPlaces() const {
  if (impl_.screen != Screen::familiarisation) return std::nullopt;
  return impl_.familiar;
}

bool Session::asks() const {
  const auto places = familiarPlaces();
  return impl_.screen == Screen::trial || (places && places->stiffer == 0);
}

int Session::trialNumber() const { return impl_.block && !impl_.block->finished() ? impl_.block->next().number : 0; }
int Session::trialsAtMost() const {
  return impl_.block ? impl_.settings.block.warm_up + impl_.settings.block.stop.most : 0;
}
double Session::secondsLeft(const Moment& now) const {
  if (impl_.settings.limit_s <= 0.0) return std::numeric_limits<double>::infinity();
  return std::max(0.0, impl_.settings.limit_s - impl_.elapsed(now));
}
double Session::shareOfTimeLeft(const Moment& now) const {
  if (impl_.settings.limit_s <= 0.0) return 1.0;
  return secondsLeft(now) / impl_.settings.limit_s;
}
bool Session::visited(int site) const { return impl_.exploration.visited(site); }
int Session::touchedSite() const { return impl_.exploration.touchedSite(); }
bool Session::showsProgress() const { return impl_.settings.feedback; }

void Session::ready(const Moment& now) {
  if (impl_.screen != Screen::trial) return;
  const bool stands_still = paused();
  impl_.restart(now);
  if (stands_still) impl_.paused_since = now;
}

void Session::feel(const trace::Sample& sample, const Moment& /*now*/) {
  if (paused()) return;
  impl_.exploration.follow(sample);
  if (impl_.screen == Screen::trial) impl_.watch.follow(sample);
  if (impl_.screen != Screen::device_check || impl_.device_works) return;
  if (sample.device_force.norm() < impl_.plan.protocol.exploration.force_n) return;
  impl_.device_works = true;
  impl_.say(deviceCheck(true));
}

void Session::next(const Moment& now) {
  if (paused()) return goOn(now);
  switch (impl_.screen) {
    case Screen::device_check:
      if (!impl_.device_works) return impl_.say(deviceCheck(false));
      return impl_.plan.kind == SessionKind::free ? impl_.introduce(now) : impl_.familiarise();
    case Screen::familiarisation:
      return asks() ? impl_.say(stifferQuestion()) : impl_.askFamiliar();
    case Screen::instruction:
      return impl_.beginTrial(now);
    case Screen::feedback:
      return impl_.proceedAfterAnswer(now);
    case Screen::block_summary:
      return impl_.afterSummary(now);
    case Screen::free_exploration:
      return impl_.finish(now);
    case Screen::trial:
    case Screen::finished:
      return;
  }
}

bool Session::answer(int site, const Moment& now) {
  if (!asks() || paused() || impl_.plan.sites.numbered(site) == nullptr) return false;
  if (impl_.screen == Screen::familiarisation) return impl_.answerFamiliar(site, now);
  const int missing = impl_.plan.sites.choices() - impl_.exploration.visitedSites();
  if (impl_.settings.all_sites && missing > 0 && !std::exchange(impl_.warned, true)) {
    impl_.say(notPressedYet(missing));
    return false;
  }
  impl_.recordAnswer(site, now);
  return true;
}

void Session::tick(const Moment& now) {
  if (impl_.screen != Screen::trial || paused()) return;
  if (secondsLeft(now) <= 0.0) impl_.recordAnswer(0, now);
}

void Session::safety(const std::string& what, const Moment& now) { impl_.recordEvent("safety", what, now); }

std::optional<BlockResult> Session::result() const { return impl_.result; }

}  // namespace palpate::training
