#include "teach/window/session_start.h"

#include <fmt/format.h>

#include "palpate/engine/recording_settings.h"
#include "palpate/training/records/recording_files.h"
#include "palpate/training/records/trainee_code.h"
#include "palpate/training/session/trial_scene.h"

namespace palpate::viewer {

namespace {

/// The class's own, or the one that this record has always had.
training::StationRow findStation(training::Store& store, const std::optional<training::ClassStation>& of_class) {
  if (of_class) return of_class->row;
  const std::vector<training::StationRow> known = store.stations();
  training::StationRow station;
  if (!known.empty()) {
    station = known.front();
  } else {
    station.id = training::makeUuidV7(training::utcMs(), training::systemRandom());
    station.name = "station";
  }
  return station;
}

/// Returns the station's id.
training::Uuid storeNamedRows(training::Store& store, const TrainingSettings& settings, const SessionStart& start) {
  training::StationRow station = findStation(store, settings.station);
  station.device = start.holder.words;
  store.save(station);
  if (settings.station) store.save(settings.station->of);
  // Stored again for the class, which may have forgotten a trainee who was away for long.
  if (const auto trainee = store.trainee(start.who.trainee().id)) store.save(*trainee);
  store.save(training::makeProtocolRow(settings.protocol));
  return station.id;
}

}  // namespace

Holder findHolder(const ViewerState& viewer, LiveServo& servo) {
  Holder holder;
  holder.mouse = !viewer.devices.anyHeld();
  if (!holder.mouse) holder.words = viewer.held_by;
  holder.force_share = viewer.devices.stiffness_factor;
  holder.ratios_kept_to_n = viewer.devices.ratios_kept_to_n;
  for (std::size_t i = 0; i < kFingers; ++i) {
    if (!servo.isHeld(i)) continue;
    const device::Workspace& workspace = servo.opened(i).workspace;
    holder.ignored_buttons |= workspace.clutch_buttons | workspace.stop_buttons;
  }
  return holder;
}

void Holder::describe(TrainingView& view) const {
  view.device = words;
  view.by_mouse = mouse;
  view.force_share = force_share;
  view.ratios_kept_to_n = ratios_kept_to_n;
}

TrainingGround makeGround(const scene::World& world, const scene::Scene& base, const training::Protocol& protocol) {
  const auto& landmarks = world.body->anatomy.landmarks;
  return {.sites = protocol.sites.empty() ? training::twelveSites(landmarks)
                                          : training::sitesNamed(landmarks, protocol.sites),
          .base = base,
          .body = std::make_shared<const scene::World>(world)};
}

training::SessionPlan planSession(training::Store& store, const TrainingSettings& settings, const SessionStart& start) {
  const ViewerState& viewer = start.viewer;
  TrainingGround& ground = start.ground;
  training::SessionPlan plan;
  plan.row.station_id = storeNamedRows(store, settings, start);
  plan.protocol = settings.protocol;
  if (!viewer.held.empty()) {
    plan.protocol.base_n_per_mm =
        training::renderableBase(plan.protocol, ground.base, device::profileOf(ground.base.safety.device, viewer.held));
  }
  plan.kind = start.kind;
  plan.sites = ground.sites;
  plan.seed = settings.seed.value_or(training::systemRandom()[0] >> 1);
  plan.tick_s = 1.0 / viewer.ticks_per_s;
  training::SessionRow& row = plan.row;
  row.id = training::makeUuidV7(training::utcMs(), training::systemRandom());
  row.trainee_id = start.who.trainee().id;
  row.app_version = engine::recordingHeader(viewer.ticks_per_s).software;
  row.device = start.holder.mouse ? "mouse" : fmt::format("{}, {}", start.holder.words, start.who.thimble());
  if (settings.recording_files) row.file = training::RecordingFiles::nameFor(row.id);
  if (const auto interrupted = store.interrupted(row.trainee_id, plan.kind)) plan.resumed = interrupted->block;
  if (const auto before = store.lastMeasured(row.trainee_id); before && before->threshold > 0.0) {
    plan.before = training::ShownThreshold{before->threshold, before->threshold_low, before->threshold_high};
  }
  if (!training::hidesLumps(plan.kind)) return plan;
  if (!ground.lumps) {
    ground.lumps = std::make_shared<const training::LumpBodies>(ground.body, settings.protocol, ground.sites);
  }
  plan.bodies = ground.lumps;
  return plan;
}

}  // namespace palpate::viewer
