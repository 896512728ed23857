// Choosing a file: recent ones, a folder to walk through, and a line to type into.
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "apps/viewer/panels/panels.h"
#include "apps/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 8> kKinds = {".toml", ".obj", ".stl", ".ply", ".off", ".gltf", ".glb", ".csv"};

struct Listing {
  fs::path folder;
  std::vector<fs::path> folders;
  std::vector<fs::path> files;
};

bool isOurs(const fs::path& file) {
  std::string kind = file.extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(), [](unsigned char c) { return std::tolower(c); });
  return std::find(kKinds.begin(), kKinds.end(), kind) != kKinds.end();
}

Listing listingOf(const fs::path& folder) {
  Listing listing{folder, {}, {}};
  std::error_code error;
  for (fs::directory_iterator entry(folder, fs::directory_options::skip_permission_denied, error), end;
       !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    if (entry->path().filename().native().starts_with('.')) continue;
    if (entry->is_directory(ignored)) {
      listing.folders.push_back(entry->path());
    } else if (isOurs(entry->path())) {
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
  ImGui::TextDisabled("%s", listing.folder.c_str());
  fs::path next;
  if (ImGui::BeginChild("files", {0.0f, std::min(240.0f, 0.4f * ImGui::GetIO().DisplaySize.y)}, true)) {
    if (listing.folder.has_parent_path() && ImGui::Selectable("..")) next = listing.folder.parent_path();
    for (const fs::path& folder : listing.folders) {
      if (ImGui::Selectable((folder.filename().string() + "/").c_str())) next = folder;
    }
    for (const fs::path& file : listing.files) {
      if (ImGui::Selectable(file.filename().c_str())) chosen = file.string();
    }
    if (listing.folders.empty() && listing.files.empty()) remark("no scenes or meshes here");
  }
  ImGui::EndChild();
  if (!next.empty()) listing = listingOf(next);
  return chosen;
}

}  // namespace

void showFolder(const fs::path& folder) { shownListing() = listingOf(folder); }

void openDialog(std::span<const std::string> recent, bool& open, Asks& asks) {
  Listing& listing = shownListing();
  static std::string typed;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * size.x, 0.5f * size.y}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({std::min(560.0f, size.x - 40.0f), 0.0f});
  ImGui::SetNextWindowSizeConstraints({0.0f, 0.0f}, {size.x, size.y - 30.0f});
  if (ImGui::Begin("Open a scene or a mesh", &open,
                   ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings)) {
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
        "TOML scenes, OBJ, STL, PLY, OFF, glTF and GLB meshes, recorded forces (CSV); or drop a file on the window.");
    if (!chosen.empty()) {
      asks.wish(Wish::Kind::open, chosen);
      open = false;
    }
  }
  ImGui::End();
}

}  // namespace palpate::viewer
