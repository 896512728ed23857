// The displacement profile as a curve: how far the skin follows, from under the finger to the rim of the region. The
// user's own curve has handles: drag them, double click for a new one, right click to remove one.
#include <imgui.h>

#include <algorithm>

#include "palpate/base/error.h"
#include "palpate/tissue/profile_curve.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

constexpr float kHeight = 110.0f;
constexpr float kHandle = 5.0f;
constexpr double kLowest = -0.4;  ///< lowest value shown and allowed: a bulge around the finger
constexpr int kCurvePoints = 96;
constexpr int kFirstHandles = 7;
constexpr double kMinGap = 0.01;  ///< between two handles

using tissue::ProfileKind;
using tissue::ProfileKnot;
using tissue::ProfileSettings;

struct Sheet {
  ImVec2 low;
  ImVec2 size;
  /// Down on the sheet is down on the skin: a value of 1 is at the bottom.
  ImVec2 at(double q, double value) const {
    const double share = (value - kLowest) / (1.0 - kLowest);
    return {low.x + static_cast<float>(q) * size.x, low.y + static_cast<float>(share) * size.y};
  }
  ProfileKnot knotAt(const ImVec2& place) const {
    return {(place.x - low.x) / size.x, kLowest + (place.y - low.y) / size.y * (1.0 - kLowest)};
  }
};

ProfileSettings shownProfile(const ProfileSettings& of_scene, const ProfileEdit& profile) {
  ProfileSettings settings = of_scene;
  if (settings.kind == ProfileKind::user) settings.knots = profile.knots;
  return settings;
}

void drawCurve(const Sheet& sheet, const ProfileSettings& settings) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(sheet.low, {sheet.low.x + sheet.size.x, sheet.low.y + sheet.size.y},
                     ImGui::GetColorU32(ImGuiCol_FrameBg), 3.0f);
  list.AddLine(sheet.at(0.0, 0.0), sheet.at(1.0, 0.0), ImGui::GetColorU32(ImGuiCol_TextDisabled));
  const tissue::ProfileCurve curve(settings);
  std::array<ImVec2, kCurvePoints + 1> points;
  for (int i = 0; i <= kCurvePoints; ++i) {
    const double q = static_cast<double>(i) / kCurvePoints;
    points[static_cast<std::size_t>(i)] = sheet.at(q, curve.at(q).value);
  }
  list.AddPolyline(points.data(), kCurvePoints + 1, ImGui::GetColorU32(ImGuiCol_CheckMark), 0, 2.0f);
}

int handleAt(const Sheet& sheet, const std::vector<ProfileKnot>& knots, const ImVec2& mouse) {
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const ImVec2 place = sheet.at(knots[i].q, knots[i].value);
    if (std::abs(place.x - mouse.x) <= 2.0f * kHandle && std::abs(place.y - mouse.y) <= 2.0f * kHandle) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

/// The ends stay: 1 under the finger, 0 on the rim.
bool isEnd(const std::vector<ProfileKnot>& knots, int i) { return i <= 0 || i + 1 >= static_cast<int>(knots.size()); }

void moveHandle(std::vector<ProfileKnot>& knots, int i, const ProfileKnot& to) {
  if (isEnd(knots, i)) return;
  const auto k = static_cast<std::size_t>(i);
  knots[k].q = std::clamp(to.q, knots[k - 1].q + kMinGap, knots[k + 1].q - kMinGap);
  knots[k].value = std::clamp(to.value, kLowest, 1.0);
}

void addHandle(std::vector<ProfileKnot>& knots, const ProfileKnot& knot) {
  const auto after = std::find_if(knots.begin(), knots.end(), [&](const ProfileKnot& k) { return k.q > knot.q; });
  if (after == knots.begin() || after == knots.end()) return;
  if (after->q - knot.q < kMinGap || knot.q - (after - 1)->q < kMinGap) return;
  knots.insert(after, knot);
}

/// Returns true when a gesture has ended and the curve takes effect.
bool editHandles(ProfileEdit& profile, const Sheet& sheet) {
  std::vector<ProfileKnot>& knots = profile.knots;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  int& taken = profile.handle;
  bool done = false;
  if (ImGui::IsItemActivated()) taken = handleAt(sheet, knots, mouse);
  if (ImGui::IsItemActive() && taken >= 0) moveHandle(knots, taken, sheet.knotAt(mouse));
  if (ImGui::IsItemDeactivated() && taken >= 0) {
    taken = -1;
    done = true;
  }
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) &&
      handleAt(sheet, knots, mouse) < 0) {
    addHandle(knots, sheet.knotAt(mouse));
    done = true;
  }
  if (ImGui::IsItemHovered() && ImGui::IsMouseClicked(ImGuiMouseButton_Right)) {
    const int i = handleAt(sheet, knots, mouse);
    if (!isEnd(knots, i)) {
      knots.erase(knots.begin() + i);
      done = true;
    }
  }
  return done;
}

void drawHandles(std::span<const ProfileKnot> knots, const Sheet& sheet) {
  for (const ProfileKnot& knot : knots) {
    ImGui::GetWindowDrawList()->AddCircleFilled(sheet.at(knot.q, knot.value), kHandle,
                                                ImGui::GetColorU32(ImGuiCol_Text));
  }
}

/// The user's curve starts as the present one.
std::vector<ProfileKnot> firstHandles(const ProfileSettings& shown) {
  const tissue::ProfileCurve curve(shown);
  std::vector<ProfileKnot> knots;
  for (int i = 0; i < kFirstHandles; ++i) {
    const double q = static_cast<double>(i) / (kFirstHandles - 1);
    knots.push_back({q, curve.at(q).value});
  }
  knots.front().value = 1.0;
  knots.back().value = 0.0;
  return knots;
}

}  // namespace

void profileCurve(const ProfileSettings& of_scene, ProfileEdit& profile, UiOutput& output) {
  const ProfileSettings settings = shownProfile(of_scene, profile);
  const bool own = settings.kind == ProfileKind::user;
  if (own && settings.knots.size() < 2) return remark("Reading the curve ...");
  const Sheet sheet{ImGui::GetCursorScreenPos(), {ImGui::GetContentRegionAvail().x, kHeight}};
  ImGui::InvisibleButton("profile", sheet.size);
  notePlace("tissue/curve");
  try {
    drawCurve(sheet, settings);
  } catch (const Error& error) {
    remark(error.what());
  }
  if (own) {
    if (editHandles(profile, sheet)) output.request(UseProfile{});
    drawHandles(profile.knots, sheet);
    remark("Drag the handles; double click adds one, right click removes one.");
  } else if (buttonWidget("tissue/own", "Draw my own curve", "Start from this curve, with handles.")) {
    profile.knots = firstHandles(settings);
    output.request(UseProfile{});
  }
}

}  // namespace palpate::viewer
