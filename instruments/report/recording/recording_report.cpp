// The body that is shown is the one that was touched longest: worlds of one body differ in stiffness and the like only,
// and keep the order of its triangles.
#include "report/recording/recording_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "palpate/base/error.h"
#include "palpate/engine/recording_bundle.h"
#include "palpate/engine/recording_replay.h"
#include "palpate/engine/recording_settings.h"
#include "palpate/tree/triangle_tree.h"

namespace palpate::app {

namespace {

/// A proxy lies on its triangle, or on the sphere between the places that it touches: nearer than its radius.
constexpr double kFitsWithinMm = 1.0;

/// Larger ones cannot be fingers.
constexpr double kLargestFingerMm = 50.0;

/// Identifies bodies without building them.
using BodyKey = std::pair<std::string, std::uint64_t>;

struct FeltBody {
  std::uint64_t ticks = 0;
  std::map<std::uint32_t, trace::RecordingWorld> worlds;
  std::vector<trace::TouchedPlace> places;
};

std::map<BodyKey, FeltBody> feltBodies(trace::RecordingReader& recording, std::span<const trace::TouchedPlace> places) {
  std::map<std::uint32_t, trace::RecordingWorld> worlds;
  std::map<BodyKey, FeltBody> bodies;
  for (const trace::TouchedPlace& place : places) {
    auto world = worlds.find(place.world);
    if (world == worlds.end()) world = worlds.emplace(place.world, recording.world(place.world)).first;
    FeltBody& body = bodies[{world->second.body, world->second.triangles}];
    body.ticks += place.ticks;
    body.worlds.insert(*world);
    body.places.push_back(place);
  }
  return bodies;
}

std::vector<double> radiiIn(const trace::RecordingWorld& world) {
  std::vector<double> radii;
  for (const trace::RecordingSettings& settings : world.fingers) {
    const double radius = engine::contactSettingsFrom(settings.contact).radius_mm;
    radii.push_back(std::clamp(radius, trace::kMinReachMm, kLargestFingerMm));
  }
  return radii;
}

/// Whether every place is on the triangle that was felt there.
bool fits(const mesh::TriangleMesh& skin, const FeltBody& body, const std::vector<double>& reach_mm) {
  return std::all_of(body.places.begin(), body.places.end(), [&](const trace::TouchedPlace& place) {
    if (place.triangle >= skin.triangles.size()) return false;
    const auto& [a, b, c] = skin.triangles[place.triangle];
    const auto nearest =
        tree::closestOnTriangle({skin.positions[a], skin.positions[b], skin.positions[c]}, place.place);
    const double reach = place.finger < reach_mm.size() ? reach_mm[place.finger] : 0.0;
    return nearest.squared_distance <= (reach + kFitsWithinMm) * (reach + kFitsWithinMm);
  });
}

/// `folder`: present place of the files that the scene names; empty: their recorded one.
void buildSurface(const FeltBody& felt, const std::filesystem::path& folder, const Progress& progress,
                  ReportBody& body) {
  const trace::RecordingWorld& recorded = felt.worlds.begin()->second;
  body.reach_mm = radiiIn(recorded);
  const auto world =
      engine::builtWorld(recorded, folder.empty() ? std::filesystem::path(recorded.folder) : folder, progress);
  const std::size_t triangles = world->body->skin.triangles.size();
  if (triangles != recorded.triangles) {
    body.why_not = fmt::format("The body has changed since the recording: it has {} triangles instead of {}.",
                               triangles, recorded.triangles);
    return;
  }
  if (engine::hashOf(*world) != recorded.hash) {
    if (!fits(world->body->skin, felt, body.reach_mm)) {
      body.why_not = "The body has changed since the recording: the touched places are not on its skin.";
      return;
    }
    body.notes.emplace_back(
        "Body or stiffness are not bit-identical to the recorded ones, but every touched place is on this skin.");
  }
  body.tissue = scene::describe(world->tissue);
  std::string note = scene::tissueNote(world->scene, world->tissue, *world->surface.stiffness_n_per_mm);
  if (!note.empty()) body.notes.push_back("Tissue: " + std::move(note) + ".");
  body.landmarks = world->body->anatomy.landmarks;
  report(progress, "mapping the touch", 0.0);
  body.surface = trace::touchedSurface(world->body->skin, felt.places, body.reach_mm);
}

std::string bodyName(trace::RecordingReader& recording, std::uint32_t world) {
  try {
    return recording.world(world).body;
  } catch (const Error&) {
    return fmt::format("world {}, of which nothing is recorded", world);
  }
}

ReportBody reportBody(trace::RecordingReader& recording, const ReportSettings& settings,
                      const trace::RecordingStatistics& statistics, const Progress& progress) {
  ReportBody body;
  if (statistics.places.empty()) return body;
  try {
    const std::map<BodyKey, FeltBody> bodies = feltBodies(recording, statistics.places);
    const auto longest = std::max_element(bodies.begin(), bodies.end(),
                                          [](const auto& a, const auto& b) { return a.second.ticks < b.second.ticks; });
    body.name = longest->first.first;
    std::uint64_t elsewhere = 0;
    for (const auto& [key, felt] : bodies) elsewhere += key == longest->first ? 0 : felt.ticks;
    if (elsewhere > 0) {
      body.notes.push_back(fmt::format("The body changed: the map shows {}; {:.1f} s of touch were on other bodies.",
                                       body.name, statistics.seconds(elsewhere)));
    }
    const engine::CarriedFiles carried(recording);
    buildSurface(longest->second, settings.folder.empty() ? carried.folder() : settings.folder, progress, body);
    if (bodies.size() > 1) body.landmarks.clear();
  } catch (const Error& error) {
    body.why_not = fmt::format("The body cannot be built: {}.", error.what());
  }
  return body;
}

/// Each pair of finger and limits once.
void addUnsafe(trace::RecordingReader& recording, std::uint32_t number, RecordingReport& report) {
  try {
    const trace::RecordingWorld world = recording.world(number);
    for (const auto& [finger, limits] : engine::limitsIn(world, recording.facts().fingers)) {
      std::string words = finger + ": " + engine::describeLimits(limits);
      if (limits.unsafe && std::ranges::find(report.unsafe, words) == report.unsafe.end()) {
        report.unsafe.push_back(std::move(words));
      }
    }
  } catch (const Error&) {  // NOLINT(bugprone-empty-catch): bodyName says that nothing is recorded of it
  }
}

}  // namespace

RecordingReport recordingReport(trace::RecordingReader& recording, const ReportSettings& settings,
                                const Progress& progress) {
  RecordingReport report;
  report.file = settings.file;
  report.facts = recording.facts();
  report.statistics = trace::measure(recording, settings.span, progress);
  report.whole = report.facts.samples == 0 ||
                 (settings.span.from <= report.facts.first_tick && settings.span.to >= report.facts.last_tick);
  report.events = recording.events(settings.span);
  for (const trace::WorldChange& change : report.statistics.worlds) {
    report.bodies.push_back(bodyName(recording, change.world));
    addUnsafe(recording, change.world, report);
  }
  report.body = reportBody(recording, settings, report.statistics, progress);
  return report;
}

}  // namespace palpate::app
