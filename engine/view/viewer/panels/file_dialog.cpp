// Choosing a file to open or to save to: recent ones, a folder to walk through, and a line to type into.
//
// Own, because no library of Debian 12 fits: GTK's and Qt's dialogs want their own event loop next to GLFW's,
// libportal's wants a desktop portal on the session bus, which bare X servers do not have, and Native File Dialog is
// not packaged.
#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <functional>
#include <utility>

#include "palpate/base/language.h"
#include "palpate/base/path_text.h"
#include "view/viewer/files/outputs.h"
#include "view/viewer/panels/panels.h"
#include "view/viewer/panels/preview_pane.h"
#include "view/viewer/panels/widgets.h"

namespace palpate::viewer {

namespace {

namespace fs = std::filesystem;

using Kinds = std::span<const std::string_view>;
constexpr std::array<std::string_view, 9> kSceneKinds = {".toml", ".obj", ".stl", ".ply",    ".off",
                                                         ".gltf", ".glb", ".csv", ".session"};
constexpr std::array<std::string_view, 1> kPictureKinds = {".png"};
constexpr std::array<std::string_view, 2> kFilmKinds = {".webm", ".gif"};
constexpr std::array<std::string_view, 5> kPhotographKinds = {".jpg", ".jpeg", ".png", ".tif", ".tiff"};

struct Listing {
  fs::path folder;
  std::vector<fs::path> folders;
  std::vector<fs::path> files;
  Kinds kinds = kSceneKinds;
};

bool hasListedKind(Kinds kinds, const fs::path& file) {
  std::string kind = file.extension().string();
  std::transform(kind.begin(), kind.end(), kind.begin(), [](unsigned char c) { return std::tolower(c); });
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

Listing listFolder(const fs::path& folder, Kinds kinds = kSceneKinds) {
  Listing listing{folder, {}, {}, kinds};
  std::error_code error;
  for (fs::directory_iterator entry(folder, fs::directory_options::skip_permission_denied, error), end;
       !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    if (entry->path().filename().native().starts_with('.')) continue;
    if (entry->is_directory(ignored)) {
      listing.folders.push_back(entry->path());
    } else if (hasListedKind(kinds, entry->path())) {
      listing.files.push_back(entry->path());
    }
  }
  std::sort(listing.folders.begin(), listing.folders.end());
  std::sort(listing.files.begin(), listing.files.end());
  return listing;
}

/// Used on the display's thread, like ImGui's own state.
Listing& shownListing() {
  static Listing listing = listFolder(fs::current_path());
  return listing;
}

bool listRow(const std::string& name) {
  const bool clicked = ImGui::Selectable(name.c_str());
  notePlace("files/" + name);
  return clicked;
}

/// The clicked file, or none.
struct Selection {
  std::string file = {};
  bool twice = false;  ///< clicked: open it
};

/// A listing is read when the folder changes, not in every frame. `path` is the widgets'; `selected` is drawn as
/// chosen.
Selection walk(Listing& listing, const char* path, const std::string& selected = {}, float width = 0.0f) {
  Selection chosen;
  ImGui::TextDisabled("%s", listing.folder.string().c_str());
  fs::path next;
  if (ImGui::BeginChild("files", {width, std::min(240.0f, 0.4f * ImGui::GetIO().DisplaySize.y)}, true)) {
    if (listing.folder.has_parent_path() && listRow("..")) next = listing.folder.parent_path();
    for (const fs::path& folder : listing.folders) {
      if (listRow(folder.filename().string() + "/")) next = folder;
    }
    for (const fs::path& file : listing.files) {
      const std::string name = file.filename().string();
      const bool clicked = ImGui::Selectable(name.c_str(), name == selected, ImGuiSelectableFlags_AllowDoubleClick);
      notePlace(fmt::format("{}/files/{}", path, name), "Click to choose the file or open the folder.");
      if (!clicked) continue;
      chosen = {file.string(), ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)};
    }
    if (listing.folders.empty() && listing.files.empty()) remark("no matching files here");
  }
  ImGui::EndChild();
  if (!next.empty()) listing = listFolder(next, listing.kinds);
  return chosen;
}

/// A focused line to type a name into, with the buttons behind it. True when the input is confirmed.
struct NameField {
  const char* path;         ///< path of the widgets: "photograph"
  const char* button_path;  ///< "photograph/open"
  const char* button;       ///< "Open"
};
bool nameField(const NameField& field, std::string& typed, bool& open) {
  const float buttons = ImGui::CalcTextSize(tr(field.button)).x + ImGui::CalcTextSize(tr("Cancel")).x + 48.0f;
  ImGui::SetNextItemWidth(-buttons);
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::InputText(fmt::format("##{}", field.path).c_str(), &typed);
  notePlace(fmt::format("{}/file", field.path));
  ImGui::SameLine();
  const bool pressed = buttonWidget(field.button_path, field.button, "Enter");
  ImGui::SameLine();
  if (buttonWidget(fmt::format("{}/cancel", field.path).c_str(), "Cancel", "Esc")) open = false;
  return open && (pressed || enterPressed()) && !typed.empty();
}

/// Enters a typed folder; reports a missing file. Returns the file.
std::string fileTyped(Listing& listing, std::string& typed, std::string& trouble) {
  const fs::path file = listing.folder / pathOf(typed);  // a full path stays one
  std::error_code error;
  if (fs::is_directory(file, error)) {
    listing = listFolder(file.lexically_normal(), listing.kinds);
    typed.clear();
    trouble.clear();
    return {};
  }
  if (!fs::exists(file, error)) {
    trouble = trf("There is no file {}", file.lexically_normal().string());
    return {};
  }
  return file.string();
}

void troubleLine(const std::string& trouble) {
  if (!trouble.empty()) drawSeverityText(Severity::warning, trouble);
}

}  // namespace

void showFolder(const fs::path& folder) { shownListing() = listFolder(folder); }

namespace {

std::vector<fs::path> newestFirst(Kinds kinds) {
  std::vector<std::pair<fs::file_time_type, fs::path>> dated;
  for (const fs::path& file : listFolder(shownListing().folder, kinds).files) {
    std::error_code gone;
    if (const auto time = fs::last_write_time(file, gone); !gone) dated.emplace_back(time, file);
  }
  std::sort(dated.begin(), dated.end(), std::greater<>());
  std::vector<fs::path> files;
  for (auto& [time, file] : dated) files.push_back(std::move(file));
  return files;
}

}  // namespace

std::vector<fs::path> newestFilesInFolder() {
  constexpr std::array<std::string_view, 7> kKinds = {".obj", ".stl", ".ply", ".off", ".gltf", ".glb", ".session"};
  constexpr std::size_t kFew = 4;
  std::vector<fs::path> files = newestFirst(kKinds);
  files.resize(std::min(kFew, files.size()));
  return files;
}

std::vector<fs::path> photographsInFolder() { return newestFirst(kPhotographKinds); }

namespace {

/// The files on the left, the chosen one on the right. A click chooses, a second one opens.
std::string walkWithPreview(Listing& listing, std::string& typed, PreviewPane& preview) {
  constexpr float kPaneWidth = 180.0f;
  const Selection walked = walk(listing, "open", typed, ImGui::GetContentRegionAvail().x - kPaneWidth - 8.0f);
  if (!walked.file.empty()) typed = pathOf(walked.file).filename().string();
  const float height = ImGui::GetItemRectSize().y;
  ImGui::SameLine();
  if (ImGui::BeginChild("preview", {kPaneWidth, height})) preview.draw();
  ImGui::EndChild();
  return walked.twice ? walked.file : std::string();
}

/// The typed text may be a file.
void choosePreview(const Listing& listing, const std::string& typed, PreviewPane& preview) {
  const fs::path file = typed.empty() ? fs::path() : listing.folder / pathOf(typed);
  std::error_code error;
  preview.choose(hasListedKind(kSceneKinds, file) && fs::is_regular_file(file, error) ? file : fs::path());
}

}  // namespace

void openDialog(std::span<const std::string> recent, bool& open, PreviewPane& preview, UiOutput& output) {
  static std::string typed;
  static std::string trouble;
  if (!beginDialog("Open a scene or a mesh", open)) return;
  Listing& listing = shownListing();
  if (ImGui::IsWindowAppearing()) {
    listing = listFolder(listing.folder);  // files may be new since it was last open
    typed.clear();
    trouble.clear();
  }
  std::string chosen;
  for (std::size_t i = 0; i < recent.size(); ++i) {
    const std::string& file = recent[i];
    constexpr auto kFlags = ImGuiSelectableFlags_AllowDoubleClick | ImGuiSelectableFlags_DontClosePopups;
    const bool clicked = ImGui::Selectable(file.c_str(), file == typed, kFlags);
    notePlace(fmt::format("open/recent/{}", i));
    if (!clicked) continue;
    typed = file;
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) chosen = file;
  }
  choosePreview(listing, typed, preview);
  if (const std::string walked = walkWithPreview(listing, typed, preview); !walked.empty()) chosen = walked;
  if (nameField({"open", "open/open", "Open"}, typed, open)) chosen = fileTyped(listing, typed, trouble);
  troubleLine(trouble);
  remark(
      "Scenes (TOML), meshes (OBJ, STL, PLY, OFF, glTF, GLB), recordings, tables of forces (CSV). A click shows a "
      "file, Enter or a double click opens it. You can also drop a file on the window.");
  if (!chosen.empty()) {
    output.request(OpenFile{chosen});
    open = false;
  }
  endDialog(open);
}

std::string photographDialog(const char* title, bool& open) {
  static std::string typed;
  static std::string trouble;
  if (!beginDialog(title, open)) return {};
  Listing& listing = shownListing();
  if (ImGui::IsWindowAppearing()) {
    listing = listFolder(listing.folder, kPhotographKinds);
    typed.clear();
    trouble.clear();
  }
  std::string chosen = walk(listing, "photograph").file;
  if (nameField({"photograph", "photograph/open", "Open"}, typed, open)) chosen = fileTyped(listing, typed, trouble);
  troubleLine(trouble);
  remark("JPEG, PNG or TIFF. You can also drop the photograph on the window.");
  if (!chosen.empty()) open = false;
  endDialog(open);
  return chosen;
}

void saveDialog(const fs::path& now, const fs::path& folder, bool& open, UiOutput& output) {
  static std::string typed;
  if (!beginDialog("Save the scene as", open)) return;
  Listing& listing = shownListing();
  if (ImGui::IsWindowAppearing()) {
    listing = listFolder(now.empty() ? folder : now.parent_path());
    typed = now.empty() ? "scene.toml" : now.filename().string();
  }
  const fs::path walked = pathOf(walk(listing, "save").file);
  if (walked.extension() == ".toml") typed = walked.filename().string();
  if (nameField({"save", "save/save", "Save"}, typed, open)) {
    fs::path file = listing.folder / pathOf(typed);  // a full path stays one
    if (file.extension() != ".toml") file += ".toml";
    output.request(SaveScene{file.string()});
    open = false;
  }
  remark("A scene (TOML) with all changes, camera and look. You are asked before a file is replaced.");
  endDialog(open);
}

namespace {

struct SaveAs {
  const char* title;
  const char* path;         ///< path of the widgets: "picture"
  const char* button_path;  ///< "picture/save"
  const char* button;
  const char* stem;  ///< stem of the proposed name
  Kinds kinds;       ///< the first one is the default
  const char* words;
};

/// The input as a whole path, with an ending; empty, with the reason, where it cannot be used. An existing file is
/// replaced when its name is confirmed.
fs::path fileToWrite(const SaveAs& as, Listing& listing, std::string& typed, std::string& confirmed,
                     std::string& trouble) {
  fs::path file = listing.folder / pathOf(typed);
  std::error_code error;
  if (fs::is_directory(file, error)) {
    listing = listFolder(file.lexically_normal(), as.kinds);
    typed.clear();
    return {};
  }
  if (file.extension().empty()) file += as.kinds.front();
  if (!hasListedKind(as.kinds, file)) {
    trouble =
        trf("Expected a name that ends in {}", fmt::format("{}", fmt::join(as.kinds, fmt::format(" {} ", tr("or")))));
    return {};
  }
  if (!fs::is_directory(file.parent_path(), error)) {
    trouble = trf("There is no folder {}", file.parent_path().string());
    return {};
  }
  if (fs::exists(file, error) && std::exchange(confirmed, file.string()) != file.string()) {
    trouble = trf("{} already exists. Press {} again to replace it.", file.filename().string(), tr(as.button));
    return {};
  }
  return file;
}

/// Returns the file to write, or empty so far.
std::string saveAsDialog(const SaveAs& as, const fs::path& folder, bool& open) {
  static std::string typed;
  static std::string trouble;
  static std::string confirmed;
  if (!beginDialog(as.title, open)) return {};
  Listing& listing = shownListing();
  if (ImGui::IsWindowAppearing()) {
    listing = listFolder(folder, as.kinds);
    typed = freshFile(folder, as.stem, std::string(as.kinds.front())).filename().string();
    trouble.clear();
    confirmed.clear();
  }
  if (const fs::path walked = pathOf(walk(listing, as.path).file); !walked.empty()) typed = walked.filename().string();
  std::string chosen;
  if (nameField({as.path, as.button_path, as.button}, typed, open)) {
    trouble.clear();
    chosen = fileToWrite(as, listing, typed, confirmed, trouble).string();
  }
  troubleLine(trouble);
  remark(as.words);
  if (!chosen.empty()) open = false;
  endDialog(open);
  return chosen;
}

}  // namespace

void pictureDialog(const fs::path& folder, bool& open, UiOutput& output) {
  constexpr SaveAs kPicture = {toTranslate("Save the picture as"),
                               "picture",
                               "picture/save",
                               toTranslate("Save"),
                               "palpate",
                               kPictureKinds,
                               toTranslate("PNG, as the window shows it, without menus and messages.")};
  if (std::string file = saveAsDialog(kPicture, folder, open); !file.empty()) {
    output.request(TakeScreenshot{.file = std::move(file)});
  }
}

void filmDialog(const fs::path& folder, bool& open, UiOutput& output) {
  constexpr SaveAs kFilm = {toTranslate("Save a film as"),
                            "film",
                            "film/save",
                            toTranslate("Film"),
                            "film",
                            kFilmKinds,
                            toTranslate("WebM for browsers and players, or GIF for slides. It begins now and ends with "
                                        "File > Stop the film, at most 20 pictures a second.")};
  if (std::string file = saveAsDialog(kFilm, folder, open); !file.empty()) output.request(StartFilm{std::move(file)});
}

}  // namespace palpate::viewer
