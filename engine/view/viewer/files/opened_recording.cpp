#include "palpate/base/language.h"
#include "palpate/base/path_text.h"
#include "view/viewer/files/recorded_touch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "palpate/base/error.h"
#include "palpate/engine/recording_bundle.h"
#include "palpate/engine/recording_replay.h"
#include "palpate/engine/recording_settings.h"
#include "palpate/trace/recording_reader.h"

namespace palpate::viewer {

namespace {

bool sameBodies(const trace::RecordingWorld& a, const trace::RecordingWorld& b) {
  return a.body == b.body && a.triangles == b.triangles;
}

std::uint32_t newestWorld(trace::RecordingReader& viewer) {
  std::uint32_t newest = 0;
  viewer.forEachTick({viewer.facts().last_tick}, [&](std::span<const trace::Sample> samples) {
    newest = samples.back().world;
    return true;
  });
  return newest;
}

/// Those after the last change of the body, up to a maximum.
void collectSamples(trace::RecordingReader& viewer, const trace::TickSpan& span, const trace::RecordingWorld& shown,
                    RecordedTouch& recorded, const Progress& progress) {
  constexpr std::uint64_t kBetweenReports = 4096;  // ticks
  const std::uint64_t first = std::max(span.from, viewer.facts().first_tick);
  const double length = std::max(1.0, static_cast<double>(viewer.facts().last_tick - first));
  std::uint64_t tick = 0;
  std::map<std::uint32_t, bool> same;
  bool other_before = false;
  viewer.forEachTick(span, [&](std::span<const trace::Sample> samples) {
    if (tick++ % kBetweenReports == 0) {
      report(progress, "reading the recording", static_cast<double>(tick) / length);
    }
    for (const trace::Sample& sample : samples) {
      const auto known = same.find(sample.world);
      const bool is_same =
          known != same.end() ? known->second
                              : same.emplace(sample.world, sameBodies(viewer.world(sample.world), shown)).first->second;
      if (!is_same && !recorded.history.empty()) recorded.history.clear();
      other_before |= !is_same;
      if (is_same) recorded.history.add(sample);
    }
    return true;
  });
  if (other_before) recorded.notes.emplace_back(tr("Touch on earlier bodies is not shown"));
}

}  // namespace

RecordedTouch touchOfSession(const std::filesystem::path& file, const Progress& progress) {
  trace::RecordingReader viewer(file);
  const trace::RecordingFacts& facts = viewer.facts();
  if (facts.samples == 0) throw Error::inFile(file.string(), "contains no ticks");
  const double rate = facts.header.ticks_per_s;
  RecordedTouch recorded;
  recorded.file = file.string();
  recorded.ticks_per_s = rate;
  recorded.history = TouchHistory(rate, std::min(facts.seconds(), kLongestReplayS));
  const trace::RecordingWorld shown = viewer.world(newestWorld(viewer));
  const engine::CarriedFiles carried(viewer);
  recorded.world =
      engine::builtWorld(shown, carried.folder().empty() ? pathOf(shown.folder) : carried.folder(), progress);
  if (engine::hashOf(*recorded.world) != shown.hash) {
    recorded.notes.emplace_back(tr("The body or its stiffness has changed since the recording"));
  }
  trace::TickSpan span;
  const auto longest = static_cast<std::uint64_t>(kLongestReplayS * rate);
  if (facts.last_tick - facts.first_tick > longest) {
    span.from = facts.last_tick - longest;
    recorded.notes.push_back(
        trf("The last {:.0f} of {:.0f} s are shown; cut out other parts with palpate recording trim", kLongestReplayS,
            facts.seconds()));
  }
  collectSamples(viewer, span, shown, recorded, progress);
  for (std::size_t i = 0; i < std::min(kFingers, shown.fingers.size()); ++i) {
    recorded.radius_mm.push_back(engine::contactSettingsFrom(shown.fingers[i].contact).radius_mm);
  }
  for (const trace::RecordingEvent& event : viewer.events(span)) {
    if (event.kind == "mark") recorded.marks.push_back({static_cast<double>(event.tick) / rate, event.text});
  }
  if (facts.ended_by.empty()) {
    recorded.notes.emplace_back(tr("The recording was interrupted: what was written until then is shown"));
  }
  if (facts.dropped > 0) recorded.notes.push_back(trf("{} samples are missing", facts.dropped));
  return recorded;
}

}  // namespace palpate::viewer
