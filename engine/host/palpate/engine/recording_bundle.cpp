// Each file gets a folder of its own in the bundle, "files/3/back.gltf", so that files named by a glTF file are still
// next to it, and no two names meet. The scene is read, its places are changed and it is written again.
#include "palpate/engine/recording_bundle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "palpate/base/error.h"
#include "palpate/base/path_text.h"
#include "palpate/base/private_folder.h"
#include "palpate/base/text.h"
#include "palpate/mesh/files/load.h"
#include "palpate/scene/body_parts.h"
#include "palpate/scene/scene_file.h"
#include "palpate/scene/scene_writer.h"
#include "palpate/scene/skin_texture.h"
#include "palpate/trace/recording_edit.h"

namespace palpate::engine {

namespace {

namespace fs = std::filesystem;

/// SQLite's own limit of a value, less what else is in its row.
constexpr std::uint64_t kMaxBytes = 999'000'000;

/// A folder that does not exist: names in the scene of a bundle are relative to it.
const fs::path kBundle = "/bundle";

bool isWithin(const fs::path& name) {
  if (name.empty() || name.is_absolute() || name.has_root_path() || !name.has_filename()) return false;
  return std::none_of(name.begin(), name.end(), [](const fs::path& part) { return part == ".." || part == "."; }) &&
         name.string().find_first_of(std::string("\\\0", 2)) == std::string::npos;
}

/// The same place, or one in it.
bool isAtOrIn(const fs::path& file, const fs::path& place) {
  return std::mismatch(place.begin(), place.end(), file.begin(), file.end()).first == place.end();
}

bool isWordCharacter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Replaces every occurrence as a whole word.
void replaceWord(std::string& text, const std::string& word, const std::string& with) {
  if (word.empty()) return;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at)) {
    const std::size_t end = at + word.size();
    const bool begins = at == 0 || !isWordCharacter(word.front()) || !isWordCharacter(text[at - 1]);
    const bool ends = end == text.size() || !isWordCharacter(word.back()) || !isWordCharacter(text[end]);
    if (begins && ends) {
      text.replace(at, word.size(), with);
      at += with.size();
    } else {
      ++at;
    }
  }
}

class Bundle {
 public:
  Bundle(trace::RecordingReader& recording, const BundleSettings& settings)
      : recording_(recording), settings_(settings), carried_(recording), hidden_(settings.hidden) {
    hideFolders();
  }

  std::vector<fs::path> outside() {
    std::vector<fs::path> places = settings_.allowed;
    if (!carried_.folder().empty()) places.push_back(carried_.folder());
    std::error_code error;
    for (fs::path& place : places) {
      place = fs::canonical(place, error);  // one that is not there holds nothing: empty
    }
    std::erase(places, fs::path());
    std::set<fs::path> found;
    for (const fs::path& file : filesOfScenes()) {
      const fs::path real = fs::canonical(file, error);
      if (error) continue;  // `pack` reports it if it is needed
      const auto holds = [&real](const fs::path& place) { return isAtOrIn(real, place); };
      if (std::none_of(places.begin(), places.end(), holds)) found.insert(real);
    }
    return {found.begin(), found.end()};
  }

  BundleReport write(const fs::path& target, const Progress& progress) {
    if (const std::vector<fs::path> files = outside(); !files.empty()) {
      throw Error::inFile(files.front().string(), "is outside the folders that may be packed");
    }
    trace::RecordingHeader header = recording_.facts().header;
    for (std::string* text : {&header.machine, &header.notes, &header.tags}) hide(*text);
    std::vector<trace::RecordingFinger> fingers = recording_.facts().fingers;
    for (trace::RecordingFinger& finger : fingers) {
      for (std::string* text : {&finger.device, &finger.capabilities, &finger.placed}) hide(*text);
    }
    trace::WholeOrNothing whole;
    trace::RecordingWriter writer(target, header, fingers);
    whole.watch(writer);
    writer_ = &writer;
    trace::CopySettings copy;
    copy.keeps_files = false;
    copy.change_world = [this](trace::RecordingWorld& world) { pack(world); };
    copy.change_event = [this](trace::RecordingEvent& event) { hide(event.text); };
    report_.samples = trace::copyInto(writer, recording_, copy, progress).samples;
    if (!settings_.versions.empty()) {
      writer.add(trace::RecordingAttachment{recording_.facts().first_tick, "versions", "versions.txt", "text/plain",
                                            settings_.versions});
    }
    writer.setDropped(recording_.facts().dropped);
    writer.finish(recording_.facts().ended_by.empty() ? "bundled" : recording_.facts().ended_by,
                  recording_.facts().ended_utc);
    whole.commit();
    return std::move(report_);
  }

 private:
  /// The folder of the recording's files reveals who recorded it.
  void hideFolders() {
    const trace::RecordingFacts& facts = recording_.facts();
    for (std::uint64_t i = 0; i < facts.worlds; ++i) {
      const std::string folder = recording_.world(facts.first_world + i).folder;
      if (folder.size() > 1) hidden_.emplace_back(folder, ".");
    }
    std::stable_sort(hidden_.begin(), hidden_.end(),
                     [](const auto& a, const auto& b) { return a.first.size() > b.first.size(); });
  }

  fs::path sceneFolder(const trace::RecordingWorld& world) const {
    if (!settings_.folder.empty()) return settings_.folder;
    return carried_.folder().empty() ? pathOf(world.folder) : carried_.folder();
  }

  scene::Scene parseRecordedScene(const trace::RecordingWorld& world) const {
    return scene::parse(world.scene, (sceneFolder(world) / "session.toml").string());
  }

  std::vector<fs::path> filesOfScenes() {
    std::vector<fs::path> files;
    const trace::RecordingFacts& facts = recording_.facts();
    for (std::uint64_t i = 0; i < facts.worlds; ++i) {
      scene::Scene scene = parseRecordedScene(recording_.world(facts.first_world + i));
      for (const NamedFile& named : namedFiles(scene)) {
        std::error_code error;
        if (named.place->empty() || !fs::exists(*named.place, error)) continue;
        files.push_back(*named.place);
        if (!named.is_mesh) continue;
        for (const fs::path& beside : mesh::filesBeside(*named.place)) files.push_back(beside);
      }
    }
    return files;
  }

  void hide(std::string& text) const {
    for (const auto& [word, with] : hidden_) replaceWord(text, word, with);
  }

  void pack(trace::RecordingWorld& world) {
    scene::Scene scene = parseRecordedScene(world);
    for (const NamedFile& named : namedFiles(scene)) {
      if (!named.place->empty()) *named.place = kBundle / nameOf(*named.place, named);
    }
    hide(scene.title);
    for (scene::DeviceSettings& device : scene.devices) hide(device.name);
    world.scene = scene::sceneAsToml(scene, kBundle);
    world.folder.clear();
    hide(world.body);
  }

  /// Puts the file into the bundle, once, and returns its name there.
  fs::path nameOf(const fs::path& file, const NamedFile& named) {
    const auto known = names_.find(file.string());
    if (known != names_.end()) return known->second;
    const fs::path folder = fs::path("files") / std::to_string(names_.size() + 1);
    std::string own_name = file.filename().string();
    hide(own_name);
    const fs::path name = folder / pathOf(own_name);
    names_[file.string()] = name;
    std::error_code error;
    if (!named.is_needed && !fs::exists(file, error)) {
      report_.notes.push_back(
          fmt::format("{} is missing; it is not needed to replay the recording", file.filename().string()));
      return name;
    }
    add(file, name);
    if (!named.is_mesh) return name;
    for (const fs::path& beside : mesh::filesBeside(file)) {
      add(beside, folder / beside.lexically_normal().lexically_relative(file.parent_path().lexically_normal()));
    }
    return name;
  }

  void add(const fs::path& file, const fs::path& name) {
    const std::string bytes = readFile(file, kMaxBytes);
    for (const auto& [word, with] : hidden_) {
      std::string copy = bytes;
      replaceWord(copy, word, with);
      if (copy == bytes) continue;
      report_.notes.push_back(
          fmt::format("{} contains '{}'; check the file before you share it", name.filename().string(), word));
    }
    writer_->add(trace::RecordingAttachment{recording_.facts().first_tick, std::string(trace::kCarriedFile),
                                            name.generic_string(), "application/octet-stream", bytes});
    report_.files.push_back({name.generic_string(), bytes.size()});
  }

  trace::RecordingReader& recording_;
  const BundleSettings& settings_;
  CarriedFiles carried_;  ///< files of a bundle that is bundled again
  std::vector<std::pair<std::string, std::string>> hidden_;
  trace::RecordingWriter* writer_ = nullptr;
  std::map<std::string, fs::path> names_;
  BundleReport report_;
};

}  // namespace

std::vector<NamedFile> namedFiles(scene::Scene& scene) {
  std::vector<NamedFile> files = {{&scene.body.file, true},
                                  {&scene.ellipses.key_points},
                                  {&scene.deformation.contours},
                                  {&scene.deformation.profile_file},
                                  {&scene.deformation.tangential_profile_file},
                                  {&scene.tissue.force_table},
                                  {&scene.tissue.layer_table}};
  if (scene::isMadeScan(scene.body)) files.erase(files.begin());
  if (!scene::madeSeed(scene.body.texture)) files.push_back({&scene.body.texture.file, true});
  files.push_back({&scene.body.fit});
  for (scene::PlaceProfile& place : scene.profiles) {
    files.push_back({&place.press_file});
    files.push_back({&place.drag_file});
  }
  for (scene::Finger& finger : scene.fingers) files.push_back({&finger.trajectory, false, false});
  return files;
}

CarriedFiles::CarriedFiles(trace::RecordingReader& recording) {
  try {
    recording.forEachAttachment({}, [this](const trace::RecordingAttachment& attachment) {
      if (attachment.kind != trace::kCarriedFile) return;
      const fs::path name = pathOf(attachment.name);
      if (!isWithin(name)) {
        throw Error(fmt::format("the recording contains a file named '{}', which would be written outside its folder",
                                attachment.name));
      }
      if (folder_.empty()) folder_ = newTemporaryFolder("palpate-session");
      fs::create_directories((folder_ / name).parent_path());
      writeFile(folder_ / name, attachment.data);
    });
  } catch (...) {
    std::error_code ignored;
    if (!folder_.empty()) fs::remove_all(folder_, ignored);
    throw;
  }
}

CarriedFiles::~CarriedFiles() {
  std::error_code ignored;
  if (!folder_.empty()) fs::remove_all(folder_, ignored);
}

std::vector<fs::path> filesOutside(trace::RecordingReader& recording, const BundleSettings& settings) {
  return Bundle(recording, settings).outside();
}

BundleReport bundle(trace::RecordingReader& recording, const fs::path& target, const BundleSettings& settings,
                    const Progress& progress) {
  return Bundle(recording, settings).write(target, progress);
}

}  // namespace palpate::engine
