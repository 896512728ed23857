// A recording with everything that it takes to feel it again somewhere else: the files that its scene names travel in
// the recording file, under names that do not reveal their folders.
//
//   recording, files of its scene ─ bundle ─► recording with attachments of the kind "file" ─ CarriedFiles ─► a folder
//                                                                            └─ builtWorld, replay
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/scene/scene.h"
#include "palpate/trace/recording_reader.h"

namespace palpate::engine {

/// Where a scene keeps the names of files.
struct NamedFile {
  std::filesystem::path* place;
  bool is_mesh = false;   ///< it may name others
  bool is_needed = true;  ///< false: a world is built without it
};
std::vector<NamedFile> namedFiles(scene::Scene& scene);

/// The files that a recording carries, in a folder of their own as long as this lives.
class CarriedFiles {
 public:
  /// Throws Error for a name that would lie outside of the folder.
  explicit CarriedFiles(trace::RecordingReader& recording);
  ~CarriedFiles();
  CarriedFiles(const CarriedFiles&) = delete;
  CarriedFiles& operator=(const CarriedFiles&) = delete;

  /// Empty: it carries none.
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path folder_;
};

struct BundleSettings {
  std::filesystem::path folder;  ///< of the files that the scene names; empty: where they were
  /// Files and folders that may be packed. A stranger's scene may name any file of the user, under any folder; what a
  /// link leads to counts.
  std::vector<std::filesystem::path> allowed;
  /// Words that are written as others: names of people and computers. As whole words only.
  std::vector<std::pair<std::string, std::string>> hidden;
  std::string versions;  ///< versions of software and libraries, for the receiver
};

struct BundleReport {
  struct File {
    std::string name;
    std::uint64_t bytes = 0;
  };
  std::vector<File> files;
  std::uint64_t samples = 0;
  std::vector<std::string> notes;
};

/// Files that the scenes name, or that their meshes name, and that are in none of the allowed places: none is packed.
/// With all links followed, each once. Throws Error for a scene or a mesh that cannot be read.
std::vector<std::filesystem::path> filesOutside(trace::RecordingReader& recording, const BundleSettings& settings);

/// Throws Error for a file that the scene needs and that is not there, and for one outside of the allowed places.
BundleReport bundle(trace::RecordingReader& recording, const std::filesystem::path& target,
                    const BundleSettings& settings, const Progress& progress = {});

}  // namespace palpate::engine
