// Choosing a file to open or to save to: recent ones, a folder to walk through, and a line to type into.
//
// Own, because no library of Debian 12 fits: GTK's and Qt's dialogs want their own event loop beside GLFW's,
// libportal's wants a desktop portal on the recording bus, which bare X servers do not have, and Native File Dialog is
// not packaged.
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "palpate/base/path_text.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

namespace fs = std::filesystem;

using Kinds = std::span<const std::string_view>;
constexpr std::array<std::string_view, 9> kSceneKinds = {".toml", ".obj", ".stl", ".ply",    ".off",
                                                         ".gltf", ".glb", ".csv", ".session"};
constexpr std::array<std::string_view, 5> kPhotographKinds = {".jpg", ".jpeg", ".png", ".tif", ".tiff"};

struct Listing {
  fs::path folder;
  std::vector<fs::path> folders;
  std::vector<fs::path> files;
  Kinds kinds = kSceneKinds;
};

bool isOneOf(Kinds kinds, const fs::path& file) {
  std::string kind = file.extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(), [](unsigned char c) { return std::tolower(c); });
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

Listing listingOf(const fs::path& folder, Kinds kinds = kSceneKinds) {
  Listing listing{folder, {}, {}, kinds};
  std::error_code error;
  for (fs::directory_iterator entry(folder, fs::directory_options::skip_permission_denied, error), end;
       !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    if (entry->path().filename().native().starts_with('.')) continue;
    if (entry->is_directory(ignored)) {
      listing.folders.push_back(entry->path());
    } else if (isOneOf(kinds, entry->path())) {
      listing.files.push_back(entry->path());
    }
  }
  std::sort(listing.folders.begin(), listing.folders.end());
  std::sort(listing.files.begin(), listing.files.end());
  return listing;
}

/// Of the display's thread, like ImGui's own state.
Listing& shownListing() {
  static Listing listing = listingOf(fs::current_path());
  return listing;
}

/// The file that was clicked, or none. A listing is read when the folder changes, not in every frame.
std::string walk(Listing& listing) {
  std::string chosen;
  ImGui::TextDisabled("%s", listing.folder.string().c_str());
  fs::path next;
  if (ImGui::BeginChild("files", {0.0f, std::min(240.0f, 0.4f * ImGui::GetIO().DisplaySize.y)}, true)) {
    if (listing.folder.has_parent_path() && ImGui::Selectable("..")) next = listing.folder.parent_path();
    for (const fs::path& folder : listing.folders) {
      if (ImGui::Selectable((folder.filename().string() + "/").c_str())) next = folder;
    }
    for (const fs::path& file : listing.files) {
      if (ImGui::Selectable(file.filename().string().c_str())) chosen = file.string();
    }
    if (listing.folders.empty() && listing.files.empty()) remark("nothing of that kind here");
  }
  ImGui::EndChild();
  if (!next.empty()) listing = listingOf(next, listing.kinds);
  return chosen;
}

bool beginDialog(const char* title, bool& open) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * size.x, 0.5f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({std::min(560.0f, size.x - 40.0f), 0.0f});
  ImGui::SetNextWindowSizeConstraints({0.0f, 0.0f}, {size.x, size.y - 30.0f});
  return ImGui::Begin(title, &open,
                      ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings);
}

}  // namespace

void showFolder(const fs::path& folder) { shownListing() = listingOf(folder); }

void openDialog(std::span<const std::string> recent, bool& open, Asks& asks) {
  Listing& listing = shownListing();
  static std::string typed;
  if (beginDialog("Open a scene or a mesh", open)) {
    // Files may have come since it was last open.
    if (ImGui::IsWindowAppearing()) listing = listingOf(listing.folder);
    std::string chosen;
    for (const std::string& file : recent) {
      if (ImGui::Selectable(file.c_str())) chosen = file;
    }
    if (const std::string walked = walk(listing); !walked.empty()) chosen = walked;
    ImGui::SetNextItemWidth(-80.0f);
    const bool entered = ImGui::InputText("##file", &typed, ImGuiInputTextFlags_EnterReturnsTrue);
    notePlace("open/file");
    ImGui::SameLine();
    if ((buttonWidget("open/open", "Open") || entered) && !typed.empty()) chosen = typed;
    remark(
        "TOML scenes, OBJ, STL, PLY, OFF, glTF and GLB meshes, recordings, recorded forces (CSV); or drop a file on "
        "the "
        "window.");
    if (!chosen.empty()) {
      asks.request(OpenFile{chosen});
      open = false;
    }
  }
  ImGui::End();
}

std::string photographDialog(const char* title, bool& open) {
  Listing& listing = shownListing();
  static std::string typed;
  std::string chosen;
  if (beginDialog(title, open)) {
    if (ImGui::IsWindowAppearing()) listing = listingOf(listing.folder, kPhotographKinds);
    chosen = walk(listing);
    ImGui::SetNextItemWidth(-80.0f);
    const bool entered = ImGui::InputText("##photograph", &typed, ImGuiInputTextFlags_EnterReturnsTrue);
    notePlace("photograph/file");
    ImGui::SameLine();
    if ((buttonWidget("photograph/open", "Open") || entered) && !typed.empty()) chosen = typed;
    remark("JPEG, PNG or TIFF; or drop the photograph on the window.");
  }
  ImGui::End();
  return chosen;
}

void saveDialog(const fs::path& now, const fs::path& folder, bool& open, Asks& asks) {
  Listing& listing = shownListing();
  static std::string typed;
  if (beginDialog("Save the scene as", open)) {
    if (ImGui::IsWindowAppearing()) {
      listing = listingOf(now.empty() ? folder : now.parent_path());
      typed = now.empty() ? "scene.toml" : now.filename().string();
    }
    const fs::path walked = pathOf(walk(listing));
    if (walked.extension() == ".toml") typed = walked.filename().string();
    ImGui::SetNextItemWidth(-80.0f);
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    const bool entered = ImGui::InputText("##save_as", &typed, ImGuiInputTextFlags_EnterReturnsTrue);
    notePlace("save/file");
    ImGui::SameLine();
    if ((buttonWidget("save/save", "Save") || entered) && !typed.empty()) {
      fs::path file = listing.folder / pathOf(typed);  // a full path stays one
      if (file.extension() != ".toml") file += ".toml";
      asks.request(SaveScene{file.string()});
      open = false;
    }
    remark("A scene (TOML) with all that was changed, camera and look too. You are asked before a file is replaced.");
  }
  ImGui::End();
}

}  // namespace palpate::viewer
