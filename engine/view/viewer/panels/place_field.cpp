// A place by its name: typed with suggestions below, Enter flies there.
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>

#include "palpate/base/error.h"
#include "palpate/base/language.h"
#include "palpate/base/text.h"
#include "palpate/body/places.h"
#include "palpate/view/overlays/place_words.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

constexpr std::size_t kMaxSuggestions = 6;

bool isPlace(std::span<const body::SkinLandmark> landmarks, const std::string& typed) {
  try {
    body::placeNamed(landmarks, view::placeInEnglish(landmarks, typed));
    return true;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

std::vector<std::string> placesLike(std::span<const body::SkinLandmark> landmarks, std::string_view typed) {
  const std::string wanted = inSmallLetters(trimmed(typed));
  std::vector<std::string> like;
  if (wanted.empty()) return like;
  const auto words = split(wanted, ' ');
  for (std::string& name : body::placeNames(landmarks)) {
    const std::string lower = inSmallLetters(name + " " + view::placeInLanguage(name));
    const auto has = [&](std::string_view word) { return lower.find(word) != std::string::npos; };
    if (std::ranges::all_of(words, has)) like.push_back(std::move(name));
  }
  std::stable_partition(like.begin(), like.end(), [&](const std::string& name) {
    return inSmallLetters(name).starts_with(wanted) || inSmallLetters(view::placeInLanguage(name)).starts_with(wanted);
  });
  if (like.size() > kMaxSuggestions) like.resize(kMaxSuggestions);
  return like;
}

std::string firstExample(std::span<const body::SkinLandmark> landmarks) {
  const std::vector<std::string> names = body::placeNames(landmarks);
  if (names.empty()) return {};
  return std::ranges::find(names, "T6") != names.end() ? "T6" : names.front();
}

std::string examplePlaces(std::span<const body::SkinLandmark> landmarks) {
  const std::string first = firstExample(landmarks);
  const std::vector<std::string> names = body::placeNames(landmarks);
  const auto is_of_a_side = [](const std::string& name) { return name.starts_with("left "); };
  auto second = std::ranges::find(names, "left PSIS");
  if (second == names.end()) second = std::ranges::find_if(names, is_of_a_side);
  std::string examples = view::placeInLanguage(first);
  if (second != names.end() && *second != first) examples += ", " + view::placeInLanguage(*second);
  return examples;
}

namespace {

constexpr auto kPlain = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                        ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing |
                        ImGuiWindowFlags_NoNav;

/// The field itself: a window over the menu bar, whose own items cannot be given the keyboard. True for Enter.
bool searchLine(PlaceSearch& search, const std::string& here, const std::string& examples) {
  constexpr float kWidth = 180.0f;
  if (search.open && !search.focused) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(kWidth);
  const bool entered = ImGui::InputTextWithHint("##place", trf("Go to: {} ...", examples).c_str(), &search.typed,
                                                ImGuiInputTextFlags_EnterReturnsTrue);
  notePlace("menu/place");
  const bool active = ImGui::IsItemActive();
  if (active) search.open = search.focused = true;
  if (!active && search.focused && !search.over_list) search.open = search.focused = false;
  if (!here.empty()) {
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", here.c_str());
    notePlace("menu/at");
  }
  return entered;
}

/// The clicked name, or none.
std::string suggestions(const std::vector<std::string>& names, bool& over_list) {
  std::string chosen;
  ImGui::Begin("places", nullptr, kPlain);
  for (const std::string& name : names) {
    if (ImGui::Selectable(view::placeInLanguage(name).c_str())) chosen = name;
    notePlace("places/" + name);
  }
  over_list = ImGui::IsWindowHovered();
  ImGui::End();
  return chosen;
}

}  // namespace

void placeField(const PlaceField& field, UiOutput& output) {
  PlaceSearch& search = field.search;
  const auto menu = widgetPlaces().find("menu/Help");
  if (field.landmarks.empty() || menu == widgetPlaces().end()) {
    search = {};
    return;
  }
  ImGui::SetNextWindowPos({menu->second[2] + 10.0f, 0.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {2.0f, 0.0f});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0f, 1.0f});
  bool entered = false;
  ImVec2 below;
  if (ImGui::Begin("panel_place", nullptr, (kPlain & ~ImGuiWindowFlags_NoNav) | ImGuiWindowFlags_NoBackground)) {
    below = {ImGui::GetWindowPos().x, ImGui::GetWindowPos().y + ImGui::GetWindowHeight()};
    entered = searchLine(search, field.here, examplePlaces(field.landmarks));
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
  const std::vector<std::string> like = placesLike(field.landmarks, search.typed);
  std::string chosen;
  if (entered) chosen = isPlace(field.landmarks, search.typed) || like.empty() ? search.typed : like.front();
  ImGui::SetNextWindowPos(below);
  if (search.open && !entered && !like.empty()) {
    if (std::string clicked = suggestions(like, search.over_list); !clicked.empty()) chosen = std::move(clicked);
  }
  if (chosen.empty()) return;
  search = {};
  output.request(GoToPlace{chosen});
}

}  // namespace palpate::viewer
