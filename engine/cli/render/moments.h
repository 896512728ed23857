// The fingers of a scene at chosen moments: runs it without a device, as fast as it can, and keeps the requested
// frames; and those of a recording.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "cli/render/render_options.h"
#include "palpate/base/progress.h"
#include "palpate/device/finger_path.h"
#include "palpate/engine/recording_bundle.h"
#include "palpate/scene/world.h"
#include "palpate/servo/loop.h"
#include "palpate/trace/recording_reader.h"

namespace palpate::app {

/// One frame per time; times count from the first tick and must not fall. Throws Error for a time after the run's end.
std::vector<servo::TickSamples> framesAt(const scene::World& world, const device::FingerPaths& paths,
                                         std::span<const double> times_s, const Progress& progress);

/// Places, at least one, mm: the finger's tip goes to the first and on to the others.
using Pose = std::vector<Vec3>;

/// Replaces the scene's fingers by `poses` ones, one per pose.
void useFingersAt(std::size_t poses, double radius_mm, scene::Scene& scene);

/// The paths of these fingers: from outside the skin, square to it, to the first place, and on.
device::FingerPaths pathsToPoses(const scene::World& world, std::span<const Pose> poses);

// A recording as input of `palpate render`: its worlds, and its fingers at the requested moments.

class RecordedInput {
 public:
  /// Throws Error for options that set fingers or duration.
  explicit RecordedInput(const RenderOptions& options);

  /// When the recording begins, s.
  double beginS() const;
  std::vector<servo::TickSamples> framesAt(const std::vector<double>& times_s);
  /// The world that the frame was felt in, with the options' view; without fingers, the recording's first. Built again
  /// when it differs from that of the call before.
  std::shared_ptr<const scene::World> worldForFrame(const servo::TickSamples& frame, const Progress& progress);
  /// Describes how the last one differs from the recorded one; empty: it does not.
  const std::string& note() const { return note_; }

 private:
  const RenderOptions& options_;
  trace::RecordingReader recording_;
  engine::CarriedFiles carried_;
  std::uint32_t number_ = 0;
  std::shared_ptr<const scene::World> world_;
  std::string note_;
};

}  // namespace palpate::app
