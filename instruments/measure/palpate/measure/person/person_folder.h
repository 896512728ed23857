// A folder a person: its pictures, the result of each press, the decisions; and at the end a map and a scene.
//
//   protocol.toml, pictures, forces.csv ─ walkPerson ─► PersonWalk ─ writePerson ─► person.csv, scene.toml, summary
//
// Pictures stay where they are. What each press gave is kept in measured.toml with a hash of its pictures, and measured
// again only when they, or the measuring settings, have changed; an earlier decision goes with them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/measure/average.h"
#include "palpate/measure/measurement.h"
#include "palpate/measure/person/protocol.h"
#include "palpate/measure/place_stiffness.h"

namespace palpate::measure {

inline constexpr const char* kProtocolFile = "protocol.toml";
inline constexpr const char* kMeasuredFile = "measured.toml";
inline constexpr const char* kForcesFile = "forces.csv";
inline constexpr const char* kPersonFile = "person.csv";
inline constexpr const char* kSceneFile = "scene.toml";

/// Empty paths: not there.
struct PressPictures {
  std::filesystem::path before;
  std::filesystem::path before2;  ///< a second one before the press: the drift of the body alone
  std::filesystem::path after;
  std::filesystem::path released;
  std::optional<Vec2> contact_px = {};
};

/// Result of measuring a press.
struct PressOutcome {
  bool accepted = false;
  std::string row = {};                    ///< row of the key-point table (key_row.h), without its end; empty: none
  std::vector<std::string> refusals = {};  ///< each with its remedy
  std::vector<std::string> warnings = {};
  std::optional<double> null_drift_mm = {};
};

enum class Decision : unsigned char { none, accept, repeat };

struct WalkedPress {
  PlannedPress planned;
  PressPictures pictures;
  std::vector<std::string> missing = {};  ///< names of pictures that it still needs
  std::optional<PressOutcome> outcome = {};
  Decision decision = Decision::none;
  bool fresh = false;  ///< measured in this walk

  /// Whether it counts in the mean.
  bool counts() const;
};

/// The need of one way of pulling at one point.
struct PointProgress {
  std::string point;
  std::string drag;
  int counting = 0;
  int enough = 0;
};

struct PersonWalk {
  std::filesystem::path folder;
  Protocol protocol;
  std::vector<WalkedPress> presses;
  std::vector<std::string> strangers = {};  ///< pictures that belong to no press

  std::vector<PointProgress> progress() const;
  bool complete() const;
};

/// Measures one press; may write files next to the pictures (overlay).
using MeasurePress =
    std::function<PressOutcome(const Protocol&, const PlannedPress&, const PressPictures&, const Progress&)>;

/// A press through the pipeline; the null drift first where there is a second picture before.
struct PressMeasured {
  Measurement measurement;
  PressOutcome outcome;
};
PressMeasured measurePress(const Protocol& protocol, const PlannedPress& planned, const PressPictures& pictures,
                           const Photograph& before, const Photograph& after, const Progress& progress);
/// From a measurement that is there already.
PressOutcome assessPress(const Measurement& measurement, const PlannedPress& planned,
                         const std::optional<double>& null_drift_mm);

struct WalkDecisions {
  std::vector<std::string> accept = {};
  std::vector<std::string> repeat = {};
};

/// Looks for pictures, measures new ones, stores measured.toml after every press. Throws Error for a wrong protocol, a
/// decision about a press that was not measured, pictures that cannot be read (naming them).
PersonWalk walkPerson(const std::filesystem::path& folder, const MeasurePress& measure_press,
                      const WalkDecisions& decisions = {}, const Progress& progress = {});

/// Result of a complete walk.
struct PersonResult {
  Averages averages;
  std::optional<PlaceFits> stiffness = {};
  std::vector<std::string> written = {};  ///< files
};

/// Averages, and writes person.csv and scene.toml; forces.csv is used where it is. Throws Error for a walk that is not
/// complete and for forces that cannot be read or are refused.
PersonResult writePerson(const PersonWalk& walk, const Progress& progress = {});

/// protocol.toml, the stencil's sheets and checklist.md of a new folder. Throws Error where a protocol is already.
std::vector<std::string> beginPerson(const std::filesystem::path& folder, const Protocol& protocol);

}  // namespace palpate::measure
