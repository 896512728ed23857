// Listens to a run, headless or paced, and keeps what is to be kept: the table of forces, the statistics, and the
// moments whose surfaces are written afterwards.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/palpate/run_statistics.h"
#include "apps/palpate/surface_files.h"
#include "palpate/device/finger_path.h"
#include "palpate/trace/forces_csv.h"

namespace palpate::app {

class RunRecorder {
 public:
  /// Starts `forces.csv` in the folder when the scene wants it.
  RunRecorder(const scene::World& world, const device::FingerPaths& paths, const std::filesystem::path& folder);

  /// Samples in order; the fingers of a tick follow each other.
  void add(const trace::Sample& sample);

  /// Finishes forces.csv and writes the surfaces: at the times the scene asks for, and where the fingers pressed
  /// deepest.
  void finish(const Progress& progress);

  const RunStatistics& statistics() const { return statistics_; }
  /// Names of the files written, in the folder.
  const std::vector<std::string>& files() const { return files_; }
  /// The frame in which the fingers pressed deepest, and the one in which they pulled the skin farthest; empty when
  /// they never did.
  const Frame& deepest() const { return deepest_.frame; }
  const Frame& farthest() const { return farthest_; }
  /// What could not be kept, in words.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  /// A moment to keep: the first frame at or after its tick.
  struct Moment {
    std::string file;
    std::uint64_t tick = 0;
    Frame frame;
  };

  void addFrame();
  void write(const Moment& moment);

  const scene::World& world_;
  std::filesystem::path folder_;
  std::optional<trace::ForcesCsvWriter> forces_;
  RunStatistics statistics_;
  std::vector<Moment> moments_;
  Moment deepest_;
  double deepest_mm_ = 0.0;
  Frame farthest_;
  double farthest_mm_ = 0.0;
  Frame frame_;
  std::vector<std::string> files_;
  std::vector<std::string> notes_;
};

}  // namespace palpate::app
