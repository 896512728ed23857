// Builds worlds beside the display: the old body stays touchable until the new one is there, the newest wish wins.
#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "palpate/scene/world.h"

namespace palpate::viewer {

struct BuildWish {
  scene::Scene scene;
  /// Its body is used as it is, when there is one: only what lies on it is built anew.
  std::shared_ptr<const scene::World> body;
  /// A scene or mesh file to read first; the scene above then only lends its fingers to a mesh.
  std::string open;
};

struct BuildResult {
  BuildWish wish;
  std::shared_ptr<const scene::World> world;  ///< null if it failed
  std::string error;
};

/// Belongs to the display's thread; has one worker, of low priority.
class WorldBuilder {
 public:
  WorldBuilder();
  ~WorldBuilder();
  WorldBuilder(const WorldBuilder&) = delete;
  WorldBuilder& operator=(const WorldBuilder&) = delete;

  /// Work under way for an older wish is given up at its next sign of life.
  void wish(BuildWish wish);
  void cancel();
  std::optional<BuildResult> take();

  struct Progress {
    std::string stage;
    double done = 0.0;
    double since_s = 0.0;  ///< it began
  };
  /// Of the work under way, if any.
  std::optional<Progress> progress() const;

 private:
  void run();
  BuildResult build(const BuildWish& wish, std::uint64_t number);
  void note(std::uint64_t number, std::string_view stage, double done);

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<BuildWish> next_;
  std::optional<BuildResult> result_;
  Progress progress_;
  double began_s_ = 0.0;
  bool busy_ = false;
  bool quit_ = false;
  std::atomic<std::uint64_t> newest_{0};
  std::thread thread_;
};

/// The scene of a scene file, or a scene around a mesh file with the fingers of `like`. Throws Error.
scene::Scene sceneFromFile(const std::string& file, const scene::Scene& like);

}  // namespace palpate::viewer
