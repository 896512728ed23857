#include "palpate/classroom/class_board.h"

#include <algorithm>
#include <cmath>

#include "palpate/base/error.h"
#include "palpate/base/language.h"
#include "palpate/base/order_statistics.h"
#include "palpate/training/records/row_json.h"

namespace palpate::classroom {

namespace {

using training::Uuid;

constexpr double kTouchN = 0.02;  // less is noise, not a touch
/// More trainees than any class has: a station that invents them must not fill the memory.
constexpr std::size_t kMaxRemembered = 20000;

bool measures(const training::BlockRow& block) {
  return block.finished && block.threshold > 0.0 && block.method != training::Method::mastery;
}

}  // namespace

std::string_view wordsOf(Need need) {
  switch (need) {
    case Need::alarm:
      return toTranslate("device stopped");
    case Need::three_errors:
      return toTranslate("three wrong answers");
    case Need::idle:
      return toTranslate("nothing for a minute");
    case Need::sites_skipped:
      return toTranslate("places not pressed");
    case Need::too_light:
      return toTranslate("presses too lightly");
    case Need::none:
      break;
  }
  return {};
}

ClassBoard::ClassBoard(std::string class_id, const BoardRules& rules) : class_id_(std::move(class_id)), rules_(rules) {}

void ClassBoard::applyLive(StationRecord& seen, const LiveSample& live, double now_s) const {
  seen.live = live;
  seen.live_s = now_s;
  if (live.force_n > kTouchN) {
    if (seen.touching_since_s == 0.0) seen.touching_since_s = now_s;
    seen.touched_s = now_s;
  }
  if (live.force_n >= rules_.light_n) seen.firm_s = now_s;
  seen.forces.push_back({now_s, live.force_n});
  while (now_s - seen.forces.front().s > kForcesKeptS) seen.forces.pop_front();
}

void ClassBoard::applyState(StationRecord& seen, const std::optional<StationState>& state, double now_s) {
  const bool same_trial = seen.state && state && seen.state->session == state->session &&
                          seen.state->trial == state->trial && seen.state->screen == state->screen;
  if (!same_trial) {
    seen.state_since_s = now_s;
    seen.touching_since_s = 0.0;
  }
  if (!seen.state || !state || seen.state->session != state->session) seen.threshold = seen.low = seen.high = 0.0;
  seen.state = state;
}

bool ClassBoard::applyRow(StationRecord& seen, std::string_view kind, std::string_view payload) {
  const auto message = parseRowMessage(payload);
  if (!message) return false;
  try {
    const training::AnyRow row = training::rowFromJson(kind, message->body);
    if (const auto* session = std::get_if<training::SessionRow>(&row)) {
      if (trainee_of_session_.size() < kMaxRemembered) trainee_of_session_[session->id] = session->trainee_id;
    } else if (const auto* block = std::get_if<training::BlockRow>(&row)) {
      if (seen.state && seen.state->session == block->session_id) {
        seen.threshold = block->threshold;
        seen.low = block->threshold_low;
        seen.high = block->threshold_high;
      }
      if (const auto found = trainee_of_session_.find(block->session_id); found != trainee_of_session_.end()) {
        remember(found->second, *block);
      }
    }
  } catch (const Error&) {
    return false;
  }
  return true;
}

bool ClassBoard::acceptMessage(std::string_view topic, std::string_view payload, double now_s) {
  const auto at = parseTopic(topic);
  if (!at || at->class_id != class_id_) return false;
  if (at->kind == "ack" || at->kind == "cmd") return true;
  if (seen_.size() >= kMaxRemembered && !seen_.contains(at->station)) return false;
  StationRecord& seen = seen_[at->station];
  if (at->kind == "live") {
    const auto live = parseLive(payload);
    if (live) applyLive(seen, live->content, now_s);
    return live.has_value();
  }
  if (at->kind == "status") {
    const auto status = parseStatus(payload);
    if (status) seen.status = status->content;
    return status.has_value() || payload.empty();
  }
  if (at->kind == "state") {
    const auto state = parseState(payload);
    if (!state && !payload.empty()) return false;
    if (state && trainee_of_session_.size() < kMaxRemembered) {
      trainee_of_session_[state->content.session] = state->content.trainee;
    }
    applyState(seen, state ? std::optional(state->content) : std::nullopt, now_s);
    return true;
  }
  return isRowKind(at->kind) && applyRow(seen, at->kind, payload);
}

Need ClassBoard::assessNeed(const StationRecord& seen, double now_s) const {
  if (!seen.status.online) return Need::none;
  if (!seen.status.safety.empty() && seen.status.safety != "ok") return Need::alarm;
  if (!seen.state) return Need::none;
  const StationState& state = *seen.state;
  if (state.wrong_in_a_row >= rules_.errors) return Need::three_errors;
  const bool in_trial = state.screen == training::Screen::trial && !state.paused;
  const double quiet_s = now_s - std::max(seen.state_since_s, seen.touched_s);
  if (in_trial && quiet_s >= rules_.idle_s) return Need::idle;
  if (state.sites_skipped > 0) return Need::sites_skipped;
  const bool light_before = state.palpate_force_n > 0.0 && state.palpate_force_n < rules_.light_n;
  const bool light_now = in_trial && seen.touching_since_s > 0.0 &&
                         now_s - std::max(seen.touching_since_s, seen.firm_s) >= rules_.light_for_s &&
                         now_s - seen.touched_s < rules_.stale_s;
  return light_before || light_now ? Need::too_light : Need::none;
}

Tile ClassBoard::makeTile(const std::string& station, const StationRecord& seen, double now_s) const {
  Tile tile;
  tile.station = station;
  tile.online = seen.status.online;
  tile.status = seen.status;
  tile.state = seen.state;
  if (tile.state && seen.threshold > 0.0) {
    tile.state->threshold = seen.threshold;
    tile.state->low = seen.low;
    tile.state->high = seen.high;
  }
  tile.live = seen.live;
  if (seen.live_s) tile.age_s = std::max(0.0, now_s - *seen.live_s);
  tile.fresh = tile.online && tile.age_s && *tile.age_s <= rules_.stale_s;
  tile.need = assessNeed(seen, now_s);
  return tile;
}

std::vector<Tile> ClassBoard::tiles(double now_s) const {
  std::vector<Tile> all;
  all.reserve(seen_.size());
  for (const auto& [station, seen] : seen_) all.push_back(makeTile(station, seen, now_s));
  std::ranges::stable_sort(all, {}, &Tile::need);
  return all;
}

std::optional<Tile> ClassBoard::tile(std::string_view station, double now_s) const {
  const auto found = seen_.find(station);
  return found == seen_.end() ? std::nullopt : std::optional(makeTile(found->first, found->second, now_s));
}

std::vector<ForcePoint> ClassBoard::forces(std::string_view station) const {
  const auto found = seen_.find(station);
  if (found == seen_.end()) return {};
  return {found->second.forces.begin(), found->second.forces.end()};
}

void ClassBoard::remember(const Uuid& trainee, const training::BlockRow& block) {
  if (!measures(block) || (measured_.size() >= kMaxRemembered && !measured_.contains(trainee))) return;
  measured_[trainee][block.id] = block.threshold;
}

std::vector<CurvePoint> ClassBoard::learningCurve() const {
  std::vector<std::vector<double>> columns;
  for (const auto& [trainee, blocks] : measured_) {
    if (columns.size() < blocks.size()) columns.resize(blocks.size());
    std::size_t number = 0;
    for (const auto& [block, threshold] : blocks) columns[number++].push_back(threshold);
  }
  std::vector<CurvePoint> curve;
  for (const std::vector<double>& column : columns) {
    curve.push_back({static_cast<int>(curve.size()) + 1, static_cast<int>(column.size()), quantileOf(column, 0.5),
                     quantileOf(column, 0.25), quantileOf(column, 0.75)});
  }
  return curve;
}

}  // namespace palpate::classroom
