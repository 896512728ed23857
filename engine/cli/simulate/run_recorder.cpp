#include "cli/simulate/run_recorder.h"

#include <fmt/format.h>
#include <algorithm>
#include <bit>
#include <cmath>

#include "palpate/base/path_text.h"
#include "palpate/engine/recording_settings.h"
#include "palpate/servo/scripted_rig.h"

namespace palpate::app {

RunStatistics::RunStatistics(std::size_t fingers, std::size_t triangles)
    : fingers_(fingers), visited_(fingers, std::vector<bool>(triangles, false)) {}

void RunStatistics::add(const trace::Sample& sample) {
  FingerStatistics& finger = fingers_[sample.finger];
  const contact::FingerOutput& contact = sample.contact;
  const double force = contact.force.norm();
  hash_.add(contact.force);
  ++finger.ticks;
  finger.peak_device_force_n = std::max(finger.peak_device_force_n, sample.device_force.norm());
  for (std::uint32_t bits = sample.safety; bits != 0; bits &= bits - 1) {
    ++finger.interventions.at(static_cast<std::size_t>(std::countr_zero(bits)));
  }
  if (contact.touch == contact::Touch::free) return;
  ++finger.touching;
  (contact.touch == contact::Touch::stick ? finger.sticking : finger.slipping) += 1;
  finger.limited += sample.device_force != contact.force ? 1 : 0;
  finger.peak_force_n = std::max(finger.peak_force_n, force);
  finger.sum_force_n += force;
  if (contact.depth_mm > finger.peak_depth_mm) {
    finger.peak_depth_mm = contact.depth_mm;
    finger.deepest_at = contact.proxy;
  }
  finger.sum_depth_mm += contact.depth_mm;
  auto visited = visited_[sample.finger].begin() + static_cast<std::ptrdiff_t>(contact.triangle);
  if (contact.triangle != kNoIndex && !*visited) {
    *visited = true;
    ++finger.triangles;
  }
}

bool RunStatistics::anyTouch() const {
  return std::any_of(fingers_.begin(), fingers_.end(), [](const auto& finger) { return finger.touching > 0; });
}

namespace {

double totalDepth(const servo::TickSamples& frame) {
  double depth = 0.0;
  for (const trace::Sample& sample : frame) depth += sample.contact.depth_mm;
  return depth;
}

/// Distance by which friction holds the skin behind or before the fingers.
double totalDrag(const servo::TickSamples& frame) {
  double drag = 0.0;
  for (const trace::Sample& sample : frame) drag += (sample.contact.proxy - sample.contact.hold).norm();
  return drag;
}

}  // namespace

RunRecorder::RunRecorder(const scene::World& world, const device::FingerPaths& paths,
                         const std::filesystem::path& folder)
    : world_(world),
      folder_(folder),
      statistics_(world.scene.fingers.size(), world.body->skin.triangles.size()),
      times_(servo::forcesSettings(world, paths)) {
  const scene::OutputSettings& output = world.scene.output;
  if (output.forces) {
    forces_.emplace(folder / "forces.csv", times_);
    files_.emplace_back("forces.csv");
  }
  for (const double seconds : output.surfaces_at_s) {
    const auto tick = static_cast<std::uint64_t>(std::llround(seconds * world.scene.ticks_per_s));
    moments_.push_back({fmt::format("surface_{:.3f}s.ply", seconds), tick, {}});
  }
  deepest_.file = "surface_deepest.ply";
}

void RunRecorder::startRecording(const servo::Rig& rig) {
  constexpr const char* kFile = "run.session";
  trace::RecordingHeader header = engine::recordingHeader(world_.scene.ticks_per_s);
  header.notes = world_.scene.title;
  std::vector<trace::RecordingFinger> fingers;
  for (std::size_t i = 0; i < rig.fingers.size(); ++i) {
    fingers.push_back(engine::recordingFinger(world_.scene.fingers[i].name, rig.fingers[i].device));
  }
  recording_.emplace(folder_ / kFile, header, fingers);
  recording_->add(engine::recordingWorld(world_, engine::feltWith(rig)));
  files_.emplace_back(kFile);
}

void RunRecorder::finishRecording(std::string_view ended_by, std::uint64_t dropped) {
  if (!recording_) return;
  recording_->setDropped(dropped);
  recording_->finish(ended_by);
}

void RunRecorder::add(const trace::Sample& sample) {
  if (forces_) forces_->add(sample);
  if (recording_) recording_->add(sample);
  statistics_.add(sample);
  frame_.push_back(sample);
  if (frame_.size() < world_.scene.fingers.size()) return;
  addFrame();
  frame_.clear();
}

void RunRecorder::addFrame() {
  for (Moment& moment : moments_) {
    if (moment.frame.empty() && frame_.front().tick >= moment.tick) moment.frame = frame_;
  }
  const double depth = totalDepth(frame_);
  if (depth > deepest_mm_) {
    deepest_mm_ = depth;
    deepest_.frame = frame_;
  }
  const double drag = totalDrag(frame_);
  if (drag > farthest_mm_) {
    farthest_mm_ = drag;
    farthest_ = frame_;
  }
}

void RunRecorder::write(const Moment& moment) {
  if (moment.frame.empty()) return;
  writeSurface(folder_ / pathOf(moment.file), world_, moment.frame);
  files_.push_back(moment.file);
}

void RunRecorder::finish(const Progress& progress) {
  if (forces_) forces_->commit();
  for (std::size_t i = 0; i < moments_.size(); ++i) {
    report(progress, "writing surfaces", static_cast<double>(i) / static_cast<double>(moments_.size() + 1));
    write(moments_[i]);
    if (moments_[i].frame.empty())
      notes_.push_back(fmt::format("{} was not written: the run ended before its time", moments_[i].file));
  }
  write(deepest_);
}

}  // namespace palpate::app
