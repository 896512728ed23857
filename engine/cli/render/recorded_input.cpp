#include "cli/render/moments.h"

#include "cli/recording/recording_export.h"
#include "palpate/base/error.h"
#include "palpate/base/path_text.h"
#include "palpate/engine/recording_settings.h"

namespace palpate::app {

namespace {

void refuseOthers(const RenderOptions& options) {
  const SimulateOptions& scene = options.scene;
  const bool replaces = !scene.mesh.empty() || !scene.trajectories.empty() || scene.radius_given ||
                        scene.seconds > 0.0 || !scene.build.empty() || !scene.posture.empty() || !options.poses.empty();
  if (!replaces) return;
  throw Error::inFile(scene.scene,
                      "is a recording with its own body and fingers; omit --mesh, --trajectory, --radius-mm, "
                      "--seconds, --build, --posture and --pose");
}

}  // namespace

RecordedInput::RecordedInput(const RenderOptions& options)
    : options_(options), recording_(pathOf(options.scene.scene)), carried_(recording_) {
  refuseOthers(options);
}

double RecordedInput::beginS() const {
  const trace::RecordingFacts& facts = recording_.facts();
  return static_cast<double>(facts.first_tick) / facts.header.ticks_per_s;
}

std::vector<servo::TickSamples> RecordedInput::framesAt(const std::vector<double>& times_s) {
  return recordedFrames(recording_, times_s);
}

std::shared_ptr<const scene::World> RecordedInput::worldForFrame(const servo::TickSamples& frame,
                                                                 const Progress& progress) {
  const auto first = static_cast<std::uint32_t>(recording_.facts().first_world);
  const std::uint32_t number = frame.empty() ? first : frame.front().world;
  if (world_ == nullptr || number != number_) {
    world_ = worldToSee(
        recording_, number, carried_.folder(),
        [this](scene::Scene& scene) { scene.view = applyViewOptions(options_, scene.view); }, progress);
    number_ = number;
    note_ = engine::noteOfAnotherWorld(recording_.world(number), number, *world_);
  }
  requireFitting(frame, *world_);
  return world_;
}

}  // namespace palpate::app
