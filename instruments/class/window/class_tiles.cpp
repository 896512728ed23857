#include "class/window/class_window.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "palpate/base/language.h"

namespace palpate::viewer {

namespace {

using classroom::Need;
using classroom::Tile;

constexpr double kFullForceN = 5.0;  ///< force of a full bar: harder than anyone palpates
/// Texts that stations report about their device (training_mode.cpp).
constexpr const char* kEmergencyStop = toTranslate("emergency stop");
constexpr double kCountsN = 0.5;  ///< a press counts from here on (training/exploration.h)

// Blue and orange are distinguishable with any colour vision; what they mean is also written.
constexpr ImU32 kCalm = IM_COL32(86, 156, 214, 255);
constexpr ImU32 kUrgent = IM_COL32(230, 145, 40, 255);
constexpr ImU32 kStale = IM_COL32(120, 120, 120, 255);

ImU32 inkOfText(float opacity = 1.0f) {
  ImVec4 ink = ImGui::GetStyleColorVec4(ImGuiCol_Text);
  ink.w *= opacity;
  return ImGui::ColorConvertFloat4ToU32(ink);
}

std::string sessionKindName(training::SessionKind kind) {
  switch (kind) {
    case training::SessionKind::practice:
      return tr("practice");
    case training::SessionKind::mastery:
      return tr("mastery");
    case training::SessionKind::pre_test:
      return tr("pre-test");
    case training::SessionKind::post_test:
      return tr("post-test");
    case training::SessionKind::exam:
      return tr("exam");
    case training::SessionKind::retention:
      return tr("retention");
    case training::SessionKind::lump:
      return tr("lumps");
    case training::SessionKind::lump_exam:
      return tr("examination with lumps");
    case training::SessionKind::free:
      break;
  }
  return tr("free");
}

std::string formatDataAge(const Tile& tile) {
  if (!tile.online) return tr("offline");
  if (!tile.age_s) return tr("no data yet");
  if (*tile.age_s < 2.0) return fmt::format("{:.1f} s", WrittenNumber{*tile.age_s});
  return *tile.age_s < 100.0 ? trf("{:.0f} s old", *tile.age_s) : tr("long ago");
}

std::string describeProgress(const classroom::StationState& state) {
  if (state.screen == training::Screen::trial && state.trial > 0) {
    return trf("{}, trial {} of {}", sessionKindName(state.kind), state.trial, state.trials_at_most);
  }
  switch (state.screen) {
    case training::Screen::device_check:
      return tr("device check");
    case training::Screen::familiarisation:
      return tr("familiarisation");
    case training::Screen::instruction:
      return trf("{}, instruction", sessionKindName(state.kind));
    case training::Screen::feedback:
      return trf("{}, feedback", sessionKindName(state.kind));
    case training::Screen::block_summary:
      return trf("{}, block done", sessionKindName(state.kind));
    case training::Screen::free_exploration:
      return tr("free exploration");
    default:
      return tr("finished");
  }
}

bool hasConclusiveThreshold(const classroom::StationState& state) {
  return training::ThresholdSummary{.median = state.threshold, .low = state.low, .high = state.high}.isConclusive();
}

std::string formatLevel(const classroom::StationState& state) {
  std::string words = state.change > 0.0 ? trf("level {:.0f} %", 100.0 * state.change) : std::string();
  if (state.threshold > 0.0) {
    words += (words.empty() ? "" : ", ") +
             (hasConclusiveThreshold(state)
                  ? trf("{:.0f} % ({:.0f} to {:.0f} %)", 100.0 * state.threshold, 100.0 * state.low, 100.0 * state.high)
                  : tr(training::kMoreTrialsNeeded));
  }
  return words;
}

/// A bar of the force, with a line where a press begins to count.
void forceBar(const Tile& tile, float width, float height) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const auto share = static_cast<float>(std::clamp(tile.live.force_n / kFullForceN, 0.0, 1.0));
  draw.AddRectFilled(at, {at.x + width, at.y + height}, inkOfText(0.12f));
  draw.AddRectFilled(at, {at.x + share * width, at.y + height}, tile.fresh ? kCalm : kStale);
  const float counts = at.x + width * static_cast<float>(kCountsN / kFullForceN);
  draw.AddLine({counts, at.y}, {counts, at.y + height}, inkOfText(0.8f));
  ImGui::Dummy({width, height});
}

void nameAndAge(const Tile& tile) {
  const std::string age = formatDataAge(tile);
  ImGui::TextUnformatted(tile.station.c_str());
  ImGui::SameLine(ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(age.c_str()).x);
  ImGui::TextDisabled("%s", age.c_str());
}

void needLine(Need need) {
  ImGui::PushStyleColor(ImGuiCol_Text, kUrgent);
  ImGui::TextUnformatted(fmt::format("! {}", tr(std::string(classroom::wordsOf(need)).c_str())).c_str());
  ImGui::PopStyleColor();
}

void trialLine(const classroom::StationState& state) {
  const std::string trial = describeProgress(state);
  ImGui::TextUnformatted((state.paused ? trf("{}, paused", trial) : trial).c_str());
}

void forceLine(const Tile& tile) {
  constexpr float kBarHeight = 12.0f;
  forceBar(tile, 0.55f * ImGui::GetContentRegionAvail().x, kBarHeight);
  ImGui::SameLine();
  ImGui::TextUnformatted(trf("{} pressed", tile.live.sites_pressed).c_str());
}

void tileInside(const Tile& tile, bool compact) {
  nameAndAge(tile);
  if (!tile.state) {
    ImGui::TextDisabled("%s", tile.online ? tr("not signed in") : "");
    return;
  }
  const bool needs = tile.need != Need::none;
  if (!compact || !needs) trialLine(*tile.state);
  if (!compact) ImGui::TextUnformatted(formatLevel(*tile.state).c_str());
  if (compact && needs) needLine(tile.need);
  forceLine(tile);
  if (!compact && needs) needLine(tile.need);
}

/// True when it was clicked.
bool oneTile(const Tile& tile, const TileLayout& layout, bool opened) {
  ImGui::PushStyleVar(ImGuiStyleVar_Alpha, tile.fresh || tile.age_s == std::nullopt ? 1.0f : 0.6f);
  const ImU32 edge = tile.need != Need::none ? kUrgent : opened ? kCalm : inkOfText(0.25f);
  ImGui::PushStyleColor(ImGuiCol_Border, edge);
  ImGui::PushStyleVar(ImGuiStyleVar_ChildBorderSize, opened || tile.need != Need::none ? 2.0f : 1.0f);
  if (ImGui::BeginChild(tile.station.c_str(), {layout.width, layout.height}, true,
                        ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse)) {
    tileInside(tile, layout.compact);
  }
  ImGui::EndChild();
  ImGui::PopStyleVar();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
  return ImGui::IsItemClicked();
}

struct Strip {
  ImVec2 low, high;
  ImVec2 at(double x, double y) const {  // each from 0 to 1, y upwards
    return {low.x + static_cast<float>(x) * (high.x - low.x), high.y - static_cast<float>(y) * (high.y - low.y)};
  }
};

Strip stripBegun(float height) {
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::Dummy({width, height});
  const Strip strip{low, {low.x + width, low.y + height}};
  ImGui::GetWindowDrawList()->AddRect(strip.low, strip.high, inkOfText(0.3f));
  return strip;
}

void labelAt(const ImVec2& at, const std::string& text, float opacity = 0.7f) {
  ImGui::GetWindowDrawList()->AddText(at, inkOfText(opacity), text.c_str());
}

void forceTrace(const std::vector<classroom::ForcePoint>& forces) {
  const Strip strip = stripBegun(90.0f);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  double most = 2.0;
  for (const auto& point : forces) most = std::max(most, point.force_n);
  std::vector<ImVec2> line;
  for (const auto& point : forces) {
    const double x = 1.0 + point.s / classroom::ClassBoard::kForcesKeptS;
    if (x >= 0.0) line.push_back(strip.at(std::min(1.0, x), std::clamp(point.force_n / most, 0.0, 1.0)));
  }
  const ImVec2 counts = strip.at(0.0, kCountsN / most);
  draw.AddLine(counts, strip.at(1.0, kCountsN / most), inkOfText(0.35f));
  if (line.size() > 1) draw.AddPolyline(line.data(), static_cast<int>(line.size()), kCalm, 0, 1.5f);
  labelAt({strip.low.x + 4.0f, strip.low.y + 2.0f}, trf("force, {:.1f} N", most));
  labelAt({strip.low.x + 4.0f, counts.y - 18.0f}, fmt::format("{:g} N", WrittenNumber{kCountsN}));
  labelAt({strip.high.x - 70.0f, strip.high.y - 18.0f}, tr("last 20 s"));
}

/// The smallest reliable change with its 95 % interval, on an axis of halves: 4 to 100 %.
void thresholdBand(const classroom::StationState& state) {
  if (!(state.threshold > 0.0)) {
    ImGui::TextDisabled("%s", tr("No result yet"));
    return;
  }
  if (!hasConclusiveThreshold(state)) {
    ImGui::TextDisabled("%s", tr("Smallest reliable change: more trials needed"));
    return;
  }
  ImGui::TextUnformatted(trf("Smallest reliable change {:.0f} %, 95 % interval {:.0f} to {:.0f} %",
                             100.0 * state.threshold, 100.0 * state.low, 100.0 * state.high)
                             .c_str());
  const Strip strip = stripBegun(26.0f);
  const auto place = [](double change) { return std::clamp(std::log(change / 0.04) / std::log(1.0 / 0.04), 0.0, 1.0); };
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(strip.at(place(state.low), 0.8), strip.at(place(state.high), 0.2), IM_COL32(86, 156, 214, 110));
  draw.AddLine(strip.at(place(state.threshold), 1.0), strip.at(place(state.threshold), 0.0), kCalm, 2.0f);
  for (const double tick : {0.07, 0.14, 0.28, 0.5}) {
    draw.AddLine(strip.at(place(tick), 0.0), strip.at(place(tick), 0.25), inkOfText(0.6f));
    labelAt({strip.at(place(tick), 0.0).x + 3.0f, strip.high.y - 16.0f}, fmt::format("{:.0f}", 100.0 * tick), 0.6f);
  }
}

/// Dark figures on a light disc: readable on every tone of skin, under the finger too.
void siteLabel(const ImVec2& at, const std::string& number, bool under) {
  constexpr float kRadius = 11.0f;  // points: two figures fit
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddCircleFilled(at, kRadius, IM_COL32(250, 250, 250, 215));
  draw.AddCircle(at, kRadius, under ? kUrgent : IM_COL32(30, 30, 30, 200), 0, under ? 3.0f : 1.2f);
  const ImVec2 size = ImGui::CalcTextSize(number.c_str());
  draw.AddText({at.x - 0.5f * size.x, at.y - 0.5f * size.y}, IM_COL32(20, 20, 20, 255), number.c_str());
}

void backWithFinger(const OpenedStation& station, float height) {
  const BackPicture& back = station.back;
  const Tile& tile = station.tile;
  if (back.texture == 0) return;
  const float room = ImGui::GetContentRegionAvail().x;
  const float wide = std::min(room, height * static_cast<float>(back.aspect));
  const float high = wide / static_cast<float>(back.aspect);
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 0.5f * (room - wide));
  const ImVec2 low = ImGui::GetCursorScreenPos();
  // ImGui's OpenGL renderer takes the texture's number as if it were a pointer.
  // NOLINTNEXTLINE(performance-no-int-to-ptr)
  const auto texture = reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(back.texture));
  ImGui::Image(texture, {wide, high}, {0, 1}, {1, 0});  // OpenGL's rows run upwards
  const auto on_screen = [&](const Vec2& place) {
    return ImVec2(low.x + static_cast<float>(place.x()) * wide, low.y + static_cast<float>(place.y()) * high);
  };
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  for (std::size_t i = 0; i < back.sites.size(); ++i) {
    const bool under = tile.fresh && tile.live.site == static_cast<int>(i) + 1;
    siteLabel(on_screen(back.sites[i]), std::to_string(i + 1), under);
  }
  const auto finger = tile.online && tile.age_s ? back.seen_at(tile.live.finger_mm) : std::nullopt;
  if (!finger || finger->minCoeff() < 0.0 || finger->maxCoeff() > 1.0) return;
  const auto radius = static_cast<float>(5.0 + 4.0 * std::clamp(tile.live.force_n, 0.0, kFullForceN));
  draw.AddCircleFilled(on_screen(*finger), radius, tile.fresh ? IM_COL32(86, 156, 214, 190) : kStale);
  draw.AddCircle(on_screen(*finger), radius, IM_COL32(20, 60, 110, 255), 0, 1.5f);
}

std::optional<classroom::Command> commandRow(const Tile& tile, ClassView& view) {
  std::optional<classroom::Command> asked;
  ImGui::SetNextItemWidth(-80.0f);
  const bool entered = ImGui::InputTextWithHint("##message", tr("Message to this trainee"), view.message.data(),
                                                view.message.size(), ImGuiInputTextFlags_EnterReturnsTrue);
  ImGui::SameLine();
  if ((ImGui::Button(tr("Send")) || entered) && view.message.front() != '\0') {
    asked = {classroom::CommandKind::message, view.message.data()};
    view.message.fill('\0');
  }
  const bool paused = tile.state && tile.state->paused;
  if (ImGui::Button(paused ? tr("Continue") : tr("Pause"))) {
    asked = {paused ? classroom::CommandKind::go_on : classroom::CommandKind::pause, {}};
  }
  ImGui::SameLine();
  if (ImGui::Button(tr("Next block"))) asked = {classroom::CommandKind::next_block, {}};
  ImGui::SameLine();
  ImGui::TextDisabled("%s", view.told.c_str());
  return asked;
}

}  // namespace

std::optional<std::string> classTiles(const std::vector<Tile>& tiles, const ClassView& view, const Vec2& room) {
  std::optional<std::string> clicked;
  const TileLayout layout = tilesIn(
      {static_cast<float>(room.x()), static_cast<float>(room.y()), ImGui::GetStyle().ItemSpacing.x}, tiles.size());
  int column = 0;
  for (const Tile& tile : tiles) {
    if (column > 0) ImGui::SameLine();
    if (oneTile(tile, layout, tile.station == view.opened)) clicked = tile.station;
    column = (column + 1) % layout.columns;
  }
  return clicked;
}

std::optional<classroom::Command> openedStation(const OpenedStation& station, ClassView& view) {
  const Tile& tile = station.tile;
  ImGui::Text("%s", tile.station.c_str());
  ImGui::SameLine();
  ImGui::TextDisabled("%s", fmt::format("{}, {}", tile.status.device, formatDataAge(tile)).c_str());
  if (tile.status.safety != "ok" && !tile.status.safety.empty()) {
    ImGui::PushStyleColor(ImGuiCol_Text, kUrgent);
    const std::string& safety = tile.status.safety;
    ImGui::TextWrapped("! %s", safety == kEmergencyStop ? tr(kEmergencyStop) : safety.c_str());
    ImGui::PopStyleColor();
  }
  if (tile.state) {
    ImGui::TextUnformatted(describeProgress(*tile.state).c_str());
    if (tile.state->change > 0.0) {
      ImGui::SameLine();
      ImGui::TextDisabled("%s", trf("level {:.0f} %", 100.0 * tile.state->change).c_str());
    }
  }
  backWithFinger(station, std::max(160.0f, ImGui::GetContentRegionAvail().y - 250.0f));
  forceTrace(station.forces);
  if (tile.state) thresholdBand(*tile.state);
  ImGui::Separator();
  return commandRow(tile, view);
}

void classCurve(const std::vector<classroom::CurvePoint>& curve) {
  ImGui::TextUnformatted(tr("Class: thresholds, median and quartiles"));
  if (curve.empty()) {
    ImGui::TextDisabled("%s", tr("No finished test yet"));
    return;
  }
  const Strip strip = stripBegun(std::max(60.0f, ImGui::GetContentRegionAvail().y - 4.0f));
  double most = 0.4;
  for (const auto& point : curve) most = std::max(most, 1.1 * point.high);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const auto place = [&](const classroom::CurvePoint& point, double value) {
    return strip.at((point.number - 0.5) / static_cast<double>(curve.size()), value / most);
  };
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const auto& point = curve[i];
    draw.AddLine(place(point, point.low), place(point, point.high), kCalm, 5.0f);
    draw.AddCircleFilled(place(point, point.median), 4.0f, inkOfText());
    if (i > 0) draw.AddLine(place(curve[i - 1], curve[i - 1].median), place(point, point.median), inkOfText(0.7f));
    labelAt({place(point, 0.0).x - 12.0f, strip.high.y - 18.0f}, fmt::format("{} ({})", point.number, point.trainees));
    labelAt({place(point, point.median).x + 8.0f, place(point, point.median).y - 8.0f},
            fmt::format("{:.0f} %", 100.0 * point.median));
  }
}

}  // namespace palpate::viewer
