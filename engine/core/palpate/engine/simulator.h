// The engine in the hands of another program: a world, some fingers, one thread, no device and no clock.
//
//   tips ─► feel ─► force and contact of each finger ─► skin ─► deformed surface
//
// The caller's loop decides when a tick is; live_simulator.h is the same with a servo thread of its own.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "palpate/engine/fingers.h"
#include "palpate/engine/living_skin.h"

namespace palpate::engine {

/// One thread at a time; any number of simulators may share a world.
class Simulator {
 public:
  /// Without fingers given: the scene's, or one where it has none. Throws Error for settings that make no sense.
  explicit Simulator(std::shared_ptr<const scene::World> world, std::vector<contact::FingerSettings> fingers = {});
  /// Loads and builds a scene file. Throws Error as scene::load and scene::build do.
  explicit Simulator(const std::filesystem::path& scene_file);

  std::size_t fingers() const noexcept { return fingers_.size(); }

  /// One tick of one finger, whose tip is here now (mm, the body's frame). FingerSettings::tick_s is the time since its
  /// last tick. No allocation, lock or exception; a finger that is not there feels nothing (kTipLost).
  contact::FingerOutput feel(std::size_t finger, const Vec3& tip) noexcept;
  /// One tick of the first fingers, as many as there are tips and places for their outputs.
  void feel(std::span<const Vec3> tips, std::span<contact::FingerOutput> felt) noexcept;
  /// The finger leaves: its next tip may be anywhere, and nothing between here and there is touched.
  void lift(std::size_t finger) noexcept;

  /// The skin as the fingers' last ticks leave it. Deforms it now, in proportion to the touched regions; call it once a
  /// picture. Stays until the next call. The first call, and the first after a change of world, allocates.
  const deform::DeformedSurface& skin();
  /// Motion of the body by breath in that skin, mm, for World.breath: 0 for one that does not breathe.
  double lift() const noexcept { return skin_ ? skin_->lift() : 0.0; }

  const scene::World& world() const noexcept { return *world_; }
  /// Another world from now on. Where it has the same body (scene::rebuilt), fingers go on touching. Throws Error when
  /// it and the fingers do not suit, and then nothing has changed.
  void change(std::shared_ptr<const scene::World> world);

 private:
  std::shared_ptr<const scene::World> world_;
  std::vector<Finger> fingers_;
  std::vector<contact::FingerOutput> felt_;  ///< one per finger, of its last tick
  std::optional<LivingSkin> skin_;
};

}  // namespace palpate::engine
