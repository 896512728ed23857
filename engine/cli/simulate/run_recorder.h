// Receives the samples of a run, headless or paced, and keeps the table of forces, the statistics, and the moments
// whose surfaces are written afterwards.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "palpate/base/hash.h"
#include "palpate/device/finger_path.h"
#include "palpate/scene/world.h"
#include "palpate/servo/loop.h"
#include "palpate/trace/forces_csv.h"
#include "palpate/trace/recording_writer.h"
#include "palpate/trace/sample.h"

namespace palpate::app {

// A run in numbers, collected sample by sample: how hard and how deep each finger pressed, how it stuck and slipped.

/// One finger's numbers. Means are over the ticks in contact.
struct FingerStatistics {
  std::uint64_t ticks = 0;
  std::uint64_t touching = 0;
  std::uint64_t sticking = 0;
  std::uint64_t slipping = 0;
  std::uint64_t limited = 0;  ///< touching ticks in which the device got less, or later, than the contact's force
  std::array<std::uint64_t, servo::kSafetyBits>
      interventions{};  ///< ticks in which each bit of the safety status was set
  double peak_force_n = 0.0;
  double sum_force_n = 0.0;
  double peak_device_force_n = 0.0;
  double peak_depth_mm = 0.0;
  Vec3 deepest_at = Vec3::Zero();  ///< the place on the skin, mm
  double sum_depth_mm = 0.0;
  std::size_t triangles = 0;  ///< different ones under the proxy

  double meanForceN() const { return touching == 0 ? 0.0 : sum_force_n / static_cast<double>(touching); }
  double meanDepthMm() const { return touching == 0 ? 0.0 : sum_depth_mm / static_cast<double>(touching); }
};

class RunStatistics {
 public:
  RunStatistics(std::size_t fingers, std::size_t triangles);
  void add(const trace::Sample& sample);

  const std::vector<FingerStatistics>& fingers() const { return fingers_; }
  /// Names the run: equal for two runs with the same contact forces in every tick.
  std::uint64_t hash() const { return hash_.value(); }
  bool anyTouch() const;

 private:
  std::vector<FingerStatistics> fingers_;
  std::vector<std::vector<bool>> visited_;  ///< per finger and triangle
  Hash hash_;
};

class RunRecorder {
 public:
  /// Starts `forces.csv` in the folder when the scene wants it.
  RunRecorder(const scene::World& world, const device::FingerPaths& paths, const std::filesystem::path& folder);

  /// Also keeps the whole run as a recording file (docs/reference/recordings.md).
  void startRecording(const servo::Rig& rig);

  /// Samples in order; the fingers of a tick follow each other.
  void add(const trace::Sample& sample);

  /// Finishes forces.csv and writes the surfaces: at the times in the scene, and where the fingers pressed deepest.
  void finish(const Progress& progress);
  /// Call after `finish`: the recording notes what ended the run.
  void finishRecording(std::string_view ended_by, std::uint64_t dropped);

  const RunStatistics& statistics() const { return statistics_; }
  /// Names of the files written, in the folder.
  const std::vector<std::string>& files() const { return files_; }
  /// The frame in which the fingers pressed deepest, and the one in which they pulled the skin farthest; empty when
  /// they never did.
  const servo::TickSamples& deepest() const { return deepest_.frame; }
  const servo::TickSamples& farthest() const { return farthest_; }
  /// Describes data that could not be kept.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  /// A moment to keep: the first frame at or after its tick.
  struct Moment {
    std::string file;
    std::uint64_t tick = 0;
    servo::TickSamples frame;
  };

  void addFrame();
  void write(const Moment& moment);

  const scene::World& world_;
  std::filesystem::path folder_;
  std::optional<trace::ForcesCsvWriter> forces_;
  std::optional<trace::RecordingWriter> recording_;
  RunStatistics statistics_;
  trace::ForcesCsvSettings times_;
  std::vector<Moment> moments_;
  Moment deepest_;
  double deepest_mm_ = 0.0;
  servo::TickSamples farthest_;
  double farthest_mm_ = 0.0;
  servo::TickSamples frame_;
  std::vector<std::string> files_;
  std::vector<std::string> notes_;
};

// The deformed skin as PLY files, at a moment of the run.

/// Writes the skin deformed by these fingers: positions, displacement and its parts, strain, stiffness, and the strain
/// as colours. Throws Error.
void writeSurface(const std::filesystem::path& file, const scene::World& world, const servo::TickSamples& frame);

}  // namespace palpate::app
