// A class of simulated stations in one process: each with its own link, certificate and records, ten live samples a
// second and an answer every now and then; and one instructor who watches. tools/check-class measures with it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <set>

#include "palpate/classroom/class_folder.h"
#include "palpate/training/records/rows.h"

namespace palpate::app {

struct ClassLoadSettings {
  int first = 1;      ///< number of the first station
  int stations = 50;  ///< in one process: libmosquitto waits by select, which knows no more than 1024 open files
  double seconds = 60.0;
  double trial_every_s = 25.0;   ///< on average; 17 to 39 s in a class
  double catch_up_s = 120.0;     ///< afterwards, for what still waits
  std::filesystem::path folder;  ///< for the stations' records; must exist
};

struct ClassLoadReport {
  int stations = 0;
  std::uint64_t live_sent = 0;
  std::uint64_t live_seen = 0;
  double delay_p50_ms = 0.0, delay_p99_ms = 0.0, delay_max_ms = 0.0;
  std::uint64_t rows_sent = 0;
  std::uint64_t repeats = 0;
  std::set<training::Uuid> trials;  ///< stored by stations
  std::size_t waiting = 0;          ///< at the end
  double caught_up_s = 0.0;         ///< after the last answer, until nothing waited; negative: never
  double longest_keep_ms = 0.0;     ///< longest time to store a trial on the station's disk
};

/// `going` is called ten times a second; false ends the run.
ClassLoadReport runClassLoad(const classroom::ClassFolder& folder, const ClassLoadSettings& settings,
                             const std::function<bool(double done_s)>& going);

}  // namespace palpate::app
