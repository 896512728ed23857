#include "teach/window/site_marks.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

// On skin of any tone a light line needs a dark rim and the other way round. The pair is the Okabe-Ito palette's blue
// and orange, distinguishable with any colour vision.
constexpr ImU32 kLightInk = IM_COL32(255, 255, 255, 255);
constexpr ImU32 kDarkInk = IM_COL32(18, 20, 26, 235);
constexpr ImU32 kBlueInk = IM_COL32(86, 180, 233, 255);
constexpr ImU32 kOrangeInk = IM_COL32(230, 159, 0, 255);

constexpr float kSiteRadius = 9.0f;
constexpr float kTagAway = 24.0f;
constexpr float kTagRadius = 12.0f;
constexpr int kRound = 28;
constexpr float kEdge = 4.0f;  ///< between words and what ends the body's room

void rimmedCircle(ImDrawList& list, const ImVec2& at, float radius, ImU32 ink, float width) {
  list.AddCircle(at, radius, kDarkInk, kRound, width + 2.5f);
  list.AddCircle(at, radius, ink, kRound, width);
}

void rimmedLine(ImDrawList& list, const ImVec2& from, const ImVec2& to, ImU32 ink, float width) {
  list.AddLine(from, to, kDarkInk, width + 2.5f);
  list.AddLine(from, to, ink, width);
}

void brackets(ImDrawList& list, const ImVec2& at, float half) {
  const float arm = 0.5f * half;
  for (const float side : {-1.0f, 1.0f}) {
    const float x = at.x + side * half;
    rimmedLine(list, {x, at.y - half}, {x, at.y + half}, kLightInk, 2.5f);
    for (const float end : {-half, half}) {
      rimmedLine(list, {x, at.y + end}, {x - side * arm, at.y + end}, kLightInk, 2.5f);
    }
  }
}

void words(ImDrawList& list, const ImVec2& middle, const char* text, ImU32 ink) {
  const ImVec2 size = ImGui::CalcTextSize(text);
  list.AddText({middle.x - 0.5f * size.x, middle.y - 0.5f * size.y}, ink, text);
}

/// From the outside towards the site, with its words at the far end: an arrow to a true one, else a plain line.
void drawLeader(ImDrawList& list, const ImVec2& at, bool from_left, bool arrow, const std::string& says) {
  const float away = from_left ? -1.0f : 1.0f;
  const ImVec2 tip(at.x + away * (kTagAway + kTagRadius + 4.0f), at.y);
  const ImVec2 tail(tip.x + away * (arrow ? 44.0f : 22.0f), at.y);
  rimmedLine(list, tail, tip, arrow ? kOrangeInk : kLightInk, arrow ? 4.0f : 2.0f);
  for (const float side : {-8.0f, 8.0f}) {
    if (arrow) rimmedLine(list, {tip.x + away * 11.0f, tip.y + side}, tip, kOrangeInk, 4.0f);
  }
  const ImVec2 size = ImGui::CalcTextSize(says.c_str());
  const float width = size.x + 12.0f;
  const float wanted = from_left ? tail.x - width - 6.0f : tail.x + 6.0f;
  const float room = ImGui::GetIO().DisplaySize.x - kTrainingColumn;
  const float left = std::max(kEdge, std::min(wanted, room - width - kEdge));
  // Without room at the side of the arrow its text is below it.
  const float middle = at.y + (left == wanted ? 0.0f : size.y + 16.0f);
  const ImVec2 corner(left, middle - 0.5f * size.y - 5.0f);
  const ImVec2 opposite(left + width, middle + 0.5f * size.y + 5.0f);
  list.AddRectFilled(corner, opposite, kDarkInk, 4.0f);
  list.AddText({corner.x + 6.0f, corner.y + 5.0f}, kLightInk, says.c_str());
}

/// `bare`: nothing over a place that is touched, so that the eye sees the skin give way.
void paintSiteMark(ImDrawList& list, const ImVec2& at, float radius, const SiteMark& mark, bool bare) {
  if (!bare || !mark.touched) {
    rimmedCircle(list, at, radius, kLightInk, 2.0f);
    if (mark.pressed) list.AddCircleFilled(at, radius - 3.0f, kLightInk, kRound);
    if (mark.touched) rimmedCircle(list, at, radius + 5.0f, kBlueInk, 2.5f);
  }
  if (mark.picked) brackets(list, at, radius + 8.0f);
}

}  // namespace

void paintSiteDot(ImDrawList& list, const ImVec2& at, float radius, bool pressed) {
  const ImU32 ink = ImGui::GetColorU32(ImGuiCol_Text);
  list.AddCircle(at, radius, ink, kRound, 2.0f);
  if (pressed) list.AddCircleFilled(at, radius - 3.0f, ink, kRound);
}

int paintSiteMarks(const TrainingScreen& screen, const std::vector<SeenSite>& sites) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  int clicked = 0;
  for (const SiteMark& mark : screen.sites) {
    const auto index = static_cast<std::size_t>(mark.number) - 1;
    if (index >= sites.size() || !sites[index].at) continue;
    const SeenSite& seen = sites[index];
    const ImVec2 at(static_cast<float>(seen.at->x()), static_cast<float>(seen.at->y()));
    paintSiteMark(list, at, kSiteRadius, mark, screen.shows_sink);
    const ImVec2 tag(at.x + (seen.tag_left ? -kTagAway : kTagAway), at.y);
    list.AddCircleFilled(tag, kTagRadius, kDarkInk, kRound);
    words(list, tag, fmt::format("{}", mark.number).c_str(), kLightInk);
    if (!mark.word.empty()) drawLeader(list, at, seen.tag_left, mark.is_true, mark.word);
    if (!screen.picks_sites) continue;
    widgetPlaces()[fmt::format("training/tag/{}", mark.number)] = {tag.x - kTagRadius, tag.y - kTagRadius,
                                                                   tag.x + kTagRadius, tag.y + kTagRadius};
    // A hand that presses the skin next to it has its finger down already.
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const bool over = std::hypot(mouse.x - tag.x, mouse.y - tag.y) <= kTagRadius;
    if (over && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) clicked = mark.number;
  }
  return clicked;
}

void paintTimeRing(ImDrawList& list, const ImVec2& middle, float radius, double share) {
  constexpr float kTurn = 2.0f * std::numbers::pi_v<float>;
  constexpr float kTop = -0.25f * kTurn;
  list.AddCircle(middle, radius, ImGui::GetColorU32(ImGuiCol_TextDisabled, 0.45f), 64, 2.0f);
  const auto left = static_cast<float>(std::clamp(share, 0.0, 1.0));
  if (left <= 0.0f) return;
  list.PathArcTo(middle, radius, kTop + (1.0f - left) * kTurn, kTop + kTurn, 64);
  list.PathStroke(ImGui::GetColorU32(ImGuiCol_Text), false, 9.0f);
}

void paintOutcome(ImDrawList& list, const ImVec2& middle, float size, TrainingScreen::Outcome outcome) {
  const auto at = [&](float x, float y) { return ImVec2(middle.x + x * size, middle.y + y * size); };
  if (outcome == TrainingScreen::Outcome::right) {
    list.AddCircleFilled(middle, size, kBlueInk, 48);
    list.AddLine(at(-0.45f, 0.05f), at(-0.12f, 0.4f), kDarkInk, 0.18f * size);
    list.AddLine(at(-0.12f, 0.4f), at(0.5f, -0.38f), kDarkInk, 0.18f * size);
  } else if (outcome == TrainingScreen::Outcome::wrong) {
    // A pointing hand rather than a cross: what counts is where it was.
    list.AddCircleFilled(middle, size, kOrangeInk, 48);
    list.AddLine(at(-0.5f, 0.0f), at(0.4f, 0.0f), kDarkInk, 0.18f * size);
    list.AddLine(at(0.05f, -0.38f), at(0.45f, 0.0f), kDarkInk, 0.18f * size);
    list.AddLine(at(0.05f, 0.38f), at(0.45f, 0.0f), kDarkInk, 0.18f * size);
  }
}

}  // namespace palpate::viewer
