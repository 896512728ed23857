// Data flow: TrainingScreen -> here -> ImGui. Once a frame.
#include "teach/window/training_painting.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "palpate/window/gui.h"
#include "teach/window/site_marks.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

constexpr float kCardWidth = 620.0f;
constexpr float kWideCard = 900.0f;
constexpr float kCardPadding = 30.0f;
constexpr float kButtonHeight = 42.0f;
constexpr float kTallButton = 58.0f;
/// From this many buttons on a card has two columns, where the window is wide enough.
constexpr std::size_t kManyButtons = 7;
constexpr float kRingRadius = 44.0f;
/// Below this height of the window, points, which large text leaves of a small one, ring and buttons are smaller: the
/// words about keys must stay in sight.
constexpr float kLowRoom = 600.0f;
constexpr float kSmallRingRadius = 20.0f;
constexpr float kLowButton = 30.0f;

constexpr auto kStillWindow = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                              ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                              ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoFocusOnAppearing;

void pushLarge() {
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  ImGui::PushFont(fonts.Fonts[fonts.Fonts.Size - 1]);
}

void wrapped(const std::string& text) {
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
}

void drawGreyText(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  wrapped(text);
  ImGui::PopStyleColor();
}

void drawLargeText(const std::string& text) {
  pushLarge();
  wrapped(text);
  ImGui::PopFont();
}

/// The button that Enter presses has a frame, not only a colour.
void frameOfButton(const ImVec2& corner, const ImVec2& opposite, bool focused) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 line = ImGui::GetColorU32(focused ? ImGuiCol_Text : ImGuiCol_TextDisabled, focused ? 1.0f : 0.35f);
  list.AddRect(corner, opposite, line, 6.0f, 0, focused ? 2.5f : 1.0f);
}

constexpr float kButtonMargin = 16.0f;
constexpr float kLineGap = 5.0f;

ImVec2 textSize(const std::string& words, float width) {
  return words.empty() ? ImVec2() : ImGui::CalcTextSize(words.c_str(), nullptr, false, width - 2.0f * kButtonMargin);
}

/// Wanted height, or what its text needs.
float heightOfButton(const TrainingButton& button, float width, float wanted) {
  const float words = textSize(button.label, width).y + textSize(button.line, width).y;
  return std::max(wanted, words + (button.line.empty() ? 0.0f : kLineGap) + 12.0f);
}

void wordsOfButton(const TrainingButton& button, const ImVec2& corner, const ImVec2& opposite) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImU32 ink = ImGui::GetColorU32(button.enabled ? ImGuiCol_Text : ImGuiCol_TextDisabled);
  const float width = opposite.x - corner.x;
  const float wrap = width - 2.0f * kButtonMargin;
  const ImVec2 label = textSize(button.label, width);
  const ImVec2 line = textSize(button.line, width);
  const float gap = button.line.empty() ? 0.0f : kLineGap;
  const ImVec2 at(corner.x + kButtonMargin, 0.5f * (corner.y + opposite.y - label.y - gap - line.y));
  list.PushClipRect(corner, opposite, true);
  ImFont* font = ImGui::GetFont();
  list.AddText(font, ImGui::GetFontSize(), at, ink, button.label.c_str(), nullptr, wrap);
  if (!button.line.empty()) {
    const ImU32 grey = ImGui::GetColorU32(ImGuiCol_TextDisabled);
    list.AddText(font, ImGui::GetFontSize(), {at.x, at.y + label.y + gap}, grey, button.line.c_str(), nullptr, wrap);
  }
  if (!button.badge.empty()) {
    const ImVec2 size = ImGui::CalcTextSize(button.badge.c_str());
    const ImVec2 from(opposite.x - size.x - 26.0f, corner.y + 8.0f);
    list.AddRect(from, {opposite.x - 10.0f, from.y + size.y + 6.0f}, ImGui::GetColorU32(ImGuiCol_CheckMark), 9.0f);
    list.AddText({from.x + 8.0f, from.y + 3.0f}, ImGui::GetColorU32(ImGuiCol_CheckMark), button.badge.c_str());
  }
  list.PopClipRect();
}

bool bigButton(const TrainingButton& button, std::size_t index, const ImVec2& size, bool focused) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 opposite(corner.x + size.x, corner.y + size.y);
  const std::string id = fmt::format("##training{}", index);
  const bool clicked = ImGui::InvisibleButton(id.c_str(), size) && button.enabled;
  const bool hovered = ImGui::IsItemHovered() && button.enabled;
  notePlace(fmt::format("training/button/{}", index));
  const ImGuiCol fill = hovered ? ImGuiCol_ButtonHovered : ImGuiCol_Button;
  ImGui::GetWindowDrawList()->AddRectFilled(corner, opposite, ImGui::GetColorU32(fill, button.enabled ? 1.0f : 0.35f),
                                            6.0f);
  frameOfButton(corner, opposite, focused);
  wordsOfButton(button, corner, opposite);
  return clicked;
}

/// One below the other, or in two columns.
TrainingClick buttons(const TrainingScreen& screen, bool two_columns, float low_button = kButtonHeight) {
  TrainingClick clicked;
  const ImGuiStyle& style = ImGui::GetStyle();
  const float room = ImGui::GetContentRegionAvail().x;
  const float width = two_columns ? 0.5f * (room - style.ItemSpacing.x) : room;
  float height = 0.0f;  // row's height
  for (std::size_t i = 0; i < screen.buttons.size(); ++i) {
    const TrainingButton& button = screen.buttons[i];
    const bool second = two_columns && i % 2 == 1;
    if (second) ImGui::SameLine();
    const auto high = [&](const TrainingButton& one) {
      return heightOfButton(one, width, two_columns || !one.line.empty() ? kTallButton : low_button);
    };
    if (!second) height = high(button);
    if (two_columns && !second && i + 1 < screen.buttons.size()) height = std::max(height, high(screen.buttons[i + 1]));
    if (bigButton(button, i, {width, height}, i == screen.focus)) clicked = {button.act, button.value};
  }
  return clicked;
}

void entryBox(const TrainingScreen::Entry& entry) {
  pushLarge();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const float height = ImGui::GetFontSize() + 22.0f;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 opposite(corner.x + width, corner.y + height);
  list.AddRectFilled(corner, opposite, ImGui::GetColorU32(ImGuiCol_FrameBg), 6.0f);
  list.AddRect(corner, opposite, ImGui::GetColorU32(ImGuiCol_TextDisabled), 6.0f);
  const ImVec2 at(corner.x + 16.0f, corner.y + 11.0f);
  const bool empty = entry.text.empty();
  list.AddText(at, ImGui::GetColorU32(empty ? ImGuiCol_TextDisabled : ImGuiCol_Text),
               empty ? entry.label.c_str() : entry.text.c_str());
  const float end = at.x + (empty ? 0.0f : ImGui::CalcTextSize(entry.text.c_str()).x) + (empty ? -4.0f : 3.0f);
  list.AddLine({end, at.y - 2.0f}, {end, at.y + ImGui::GetFontSize() + 2.0f}, ImGui::GetColorU32(ImGuiCol_Text), 2.0f);
  ImGui::Dummy({width, height});
  ImGui::PopFont();
}

/// A notice has a bar at its left, one about trouble a sign as well.
void drawNotice(const TrainingScreen& screen) {
  if (screen.notice.empty()) return;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::Indent(14.0f);
  wrapped(screen.notice);
  ImGui::Unindent(14.0f);
  const float below = ImGui::GetItemRectMax().y;
  ImGui::GetWindowDrawList()->AddRectFilled({corner.x, corner.y}, {corner.x + 4.0f, below},
                                            ImGui::GetColorU32(ImGuiCol_CheckMark), 2.0f);
}

void gap(float height) { ImGui::Dummy({0.0f, height}); }

/// The body stays in sight, far behind. At the upper right: who is signed in. At the foot: what keys do.
void backdrop(const TrainingScreen& screen, const ImVec2& room) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  list.AddRectFilled({0.0f, 0.0f}, room, ImGui::GetColorU32(ImGuiCol_WindowBg, 0.82f));
  const ImU32 grey = ImGui::GetColorU32(ImGuiCol_TextDisabled);
  const ImVec2 corner = ImGui::CalcTextSize(screen.corner.c_str());
  list.AddText({room.x - corner.x - 16.0f, 12.0f}, grey, screen.corner.c_str());
  const float wrap = room.x - 24.0f;
  const ImVec2 keys = ImGui::CalcTextSize(screen.keys.c_str(), nullptr, false, wrap);
  list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {0.5f * (room.x - keys.x), room.y - keys.y - 12.0f}, grey,
               screen.keys.c_str(), nullptr, wrap);
}

/// Height of the card when it last had this text: it is centred by that.
float& cardHeight() {
  static float height = 0.0f;
  return height;
}

TrainingClick card(const TrainingScreen& screen) {
  const ImVec2 room = ImGui::GetIO().DisplaySize;
  TrainingClick clicked;
  backdrop(screen, room);
  const bool two_columns = screen.buttons.size() >= kManyButtons && room.x > kWideCard;
  const float width = std::min(two_columns ? kWideCard : kCardWidth, room.x - 24.0f);
  ImGui::SetNextWindowPos({0.5f * room.x, 0.5f * room.y}, ImGuiCond_Always, {0.5f, 0.5f});
  const float height = std::min(cardHeight(), room.y - 76.0f);
  ImGui::SetNextWindowSize({width, std::max(120.0f, height)});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {kCardPadding, kCardPadding});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 10.0f);
  ImGui::SetNextWindowBgAlpha(1.0f);
  const auto flags = kStillWindow & ~static_cast<unsigned>(ImGuiWindowFlags_NoScrollbar);
  if (ImGui::Begin("training_card", nullptr, static_cast<ImGuiWindowFlags>(flags))) {
    drawLargeText(screen.title);
    gap(6.0f);
    for (const std::string& line : screen.lines) wrapped(line);
    if (!screen.lines.empty()) gap(8.0f);
    if (screen.entry) {
      entryBox(*screen.entry);
      gap(8.0f);
    }
    drawNotice(screen);
    if (!screen.notice.empty()) gap(8.0f);
    clicked = buttons(screen, two_columns);
    cardHeight() = ImGui::GetCursorPosY() + kCardPadding - ImGui::GetStyle().ItemSpacing.y;
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
  return clicked;
}

// --- next to the body

void strip(const TrainingScreen& screen, const ImVec2& room) {
  ImGui::SetNextWindowPos({0.0f, 0.0f});
  ImGui::SetNextWindowSize({room.x - kTrainingColumn, 0.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {24.0f, 14.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
  if (ImGui::Begin("training_strip", nullptr, kStillWindow)) {
    drawLargeText(screen.title);
    for (const std::string& line : screen.lines) wrapped(line);
    drawNotice(screen);
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
}

int siteButton(const SiteMark& mark, const ImVec2& size) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 opposite(corner.x + size.x, corner.y + size.y);
  const bool clicked = ImGui::InvisibleButton(fmt::format("##site{}", mark.number).c_str(), size);
  notePlace(fmt::format("training/site/{}", mark.number));
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(corner, opposite,
                     ImGui::GetColorU32(ImGui::IsItemHovered() ? ImGuiCol_ButtonHovered : ImGuiCol_Button), 6.0f);
  frameOfButton(corner, opposite, mark.picked);
  const float middle = 0.5f * (corner.y + opposite.y);
  paintSiteDot(list, {corner.x + 20.0f, middle}, 7.0f, mark.pressed);
  const std::string number = fmt::format("{}", mark.number);
  list.AddText({corner.x + 40.0f, middle - 0.5f * ImGui::GetFontSize()}, ImGui::GetColorU32(ImGuiCol_Text),
               number.c_str());
  return clicked ? mark.number : 0;
}

/// The first half in the left column, as the twelve lie on the back.
int siteList(const TrainingScreen& screen, float height) {
  const std::size_t rows = (screen.sites.size() + 1) / 2;
  const ImGuiStyle& style = ImGui::GetStyle();
  const float width = 0.5f * (ImGui::GetContentRegionAvail().x - style.ItemSpacing.x);
  int clicked = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    clicked += siteButton(screen.sites[row], {width, height});
    if (row + rows >= screen.sites.size()) continue;
    ImGui::SameLine();
    clicked += siteButton(screen.sites[row + rows], {width, height});
  }
  return clicked;
}

void ring(const TrainingScreen& screen, float radius) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 middle(corner.x + 0.5f * ImGui::GetContentRegionAvail().x, corner.y + radius + 6.0f);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  if (screen.outcome != TrainingScreen::Outcome::none) {
    paintOutcome(list, middle, radius, screen.outcome);
  } else if (screen.time_left) {
    paintTimeRing(list, middle, radius, *screen.time_left);
  }
  ImGui::Dummy({1.0f, 2.0f * radius + 16.0f});
}

void centredGrey(const std::string& text) {
  const float width = ImGui::CalcTextSize(text.c_str()).x;
  if (width > ImGui::GetContentRegionAvail().x) return drawGreyText(text);
  ImGui::SetCursorPosX(std::max(0.0f, 0.5f * (ImGui::GetWindowWidth() - width)));
  ImGui::TextDisabled("%s", text.c_str());
}

void blockBar(const TrainingScreen& screen) {
  if (!screen.done) return;
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(corner, {corner.x + width, corner.y + 6.0f}, ImGui::GetColorU32(ImGuiCol_FrameBg), 3.0f);
  const auto done = static_cast<float>(*screen.done);
  list.AddRectFilled(corner, {corner.x + done * width, corner.y + 6.0f}, ImGui::GetColorU32(ImGuiCol_CheckMark), 3.0f);
  ImGui::Dummy({width, 12.0f});
}

float siteHeight(const TrainingScreen& screen, float room) {
  const std::size_t pairs = (screen.sites.size() + 1) / 2;
  const auto rows = static_cast<float>(pairs);
  return std::clamp(room / std::max(1.0f, rows) - ImGui::GetStyle().ItemSpacing.y, 20.0f, 36.0f);
}

TrainingClick column(const TrainingScreen& screen, const ImVec2& room) {
  TrainingClick clicked;
  ImGui::SetNextWindowPos({room.x - kTrainingColumn, 0.0f});
  ImGui::SetNextWindowSize({kTrainingColumn, room.y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {20.0f, 14.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
  const bool low = room.y < kLowRoom;
  const float button_height = low ? kLowButton : kButtonHeight;
  if (ImGui::Begin("training_column", nullptr, kStillWindow)) {
    centredGrey(screen.corner);
    ring(screen, low ? kSmallRingRadius : kRingRadius);
    if (!screen.progress.empty()) centredGrey(screen.progress);
    blockBar(screen);
    ImGui::PushTextWrapPos(0.0f);
    const float keys = ImGui::CalcTextSize(screen.keys.c_str(), nullptr, false, ImGui::GetContentRegionAvail().x).y;
    ImGui::PopTextWrapPos();
    const auto count = static_cast<float>(screen.buttons.size());
    const float below = count * (button_height + ImGui::GetStyle().ItemSpacing.y) + keys + 24.0f;
    if (screen.picks_sites) {
      const float height = siteHeight(screen, ImGui::GetContentRegionAvail().y - below);
      if (const int site = siteList(screen, height); site != 0) clicked = {TrainingAct::pick_site, site};
      gap(6.0f);
    }
    if (const TrainingClick button = buttons(screen, false, button_height); button.act != TrainingAct::none)
      clicked = button;
    ImGui::SetCursorPosY(std::max(ImGui::GetCursorPosY(), room.y - keys - 16.0f));
    drawGreyText(screen.keys);
    notePlace("training/keys");
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
  return clicked;
}

}  // namespace

TrainingClick paintTraining(const TrainingScreen& screen, const std::vector<SeenSite>& sites) {
  if (screen.place == TrainingPlace::card) return card(screen);
  const ImVec2 room = ImGui::GetIO().DisplaySize;
  const int tag = paintSiteMarks(screen, sites);
  strip(screen, room);
  const TrainingClick clicked = column(screen, room);
  if (clicked.act == TrainingAct::none && tag != 0) return {TrainingAct::pick_site, tag};
  return clicked;
}

}  // namespace palpate::viewer
