#include <imgui.h>

#include <algorithm>

#include "palpate/base/language.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

bool openCentredModal(const char* title, bool open) {
  const bool shown = ImGui::IsPopupOpen(title);
  if (!open && !shown) return false;
  if (!shown) ImGui::OpenPopup(title);
  const ImVec2 room = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * room.x, 0.5f * room.y}, ImGuiCond_Always, {0.5f, 0.5f});
  return true;
}

bool beginDialog(const char* english, bool& open) {
  const char* title = tr(english);
  if (!openCentredModal(title, open)) return false;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowSize({std::min(560.0f, size.x - 40.0f), 0.0f});
  ImGui::SetNextWindowSizeConstraints({0.0f, 0.0f}, {size.x, size.y - 30.0f});
  constexpr auto kFlags = ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings;
  return ImGui::BeginPopupModal(title, open ? &open : nullptr, kFlags);
}

void endDialog(bool& open) {
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) open = false;
  if (!open) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

bool enterPressed() {
  return ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false) ||
         ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_KeyPadEnter), false);
}

}  // namespace palpate::viewer
