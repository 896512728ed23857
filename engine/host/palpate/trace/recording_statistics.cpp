#include "palpate/trace/recording_statistics.h"

#include <algorithm>
#include <bit>

namespace palpate::trace {

namespace {

// The distributions' bins reach 41 N, 41 mm and 2 m/s, which is more than skin and hands do.
constexpr double kForceBinN = 0.005;
constexpr double kDepthBinMm = 0.005;
constexpr double kSpeedBinMmPerS = 0.25;

void tallyBits(std::uint32_t bits, std::uint32_t& before, std::uint64_t tick, BitTallies& tallies) {
  for (std::uint32_t left = bits; left != 0; left &= left - 1) {
    const auto place = static_cast<std::size_t>(std::countr_zero(left));
    BitTally& bit = tallies[place];
    ++bit.ticks;
    if ((before >> place & 1u) != 0) continue;
    if (bit.times++ == 0) bit.first_tick = tick;
  }
  before = bits;
}

template <class Thing>
void listUpTo(std::size_t most, const Thing& thing, std::vector<Thing>& things) {
  if (things.size() < most) things.push_back(thing);
}

}  // namespace

FingerStatistics::FingerStatistics()
    : in_contact{FixedHistogram(kForceBinN), FixedHistogram(kDepthBinMm), FixedHistogram(kSpeedBinMmPerS),
                 FixedHistogram(kSpeedBinMmPerS)} {}

RecordingMeasurement::RecordingMeasurement(std::size_t fingers, double ticks_per_s) {
  statistics_.ticks_per_s = ticks_per_s;
  statistics_.fingers.resize(fingers);
  for (std::size_t i = 0; i < fingers; ++i) {
    courses_.push_back(
        {FingerMotion(ticks_per_s), ContactRuns(ticks_per_s), PhaseRuns(static_cast<std::uint32_t>(i), ticks_per_s)});
  }
}

bool RecordingMeasurement::follows(std::uint64_t tick) {
  RecordedTicks& ticks = statistics_.ticks;
  if (ticks.recorded == 0) {
    ticks.first = tick;
  } else if (tick <= ticks.last) {
    ++ticks.out_of_order;
    return false;
  } else if (tick > ticks.last + 1) {
    const TickGap gap{ticks.last, tick - ticks.last - 1};
    ++ticks.gaps;
    if (gap.missing > ticks.longest_gap.missing) ticks.longest_gap = gap;
  }
  ticks.last = tick;
  ++ticks.recorded;
  return true;
}

void RecordingMeasurement::add(std::span<const Sample> samples) {
  if (samples.empty() || !follows(samples.front().tick)) return;
  for (const Sample& sample : samples) {
    if (sample.finger < courses_.size()) add(sample);
  }
}

void RecordingMeasurement::add(const Sample& sample) {
  FingerStatistics& finger = statistics_.fingers[sample.finger];
  Course& course = courses_[sample.finger];
  const bool touching = sample.contact.touch != contact::Touch::free;
  const double force = sample.contact.force.norm();
  const FingerSpeeds speeds = course.motion.add(sample);
  const MeasuredValues values = {force, sample.contact.depth_mm, speeds.proxy, speeds.tip};
  ++finger.ticks;
  finger.series.add(sample.tick, values, touching);
  if (touching) {
    ++finger.touching;
    finger.slipping += sample.contact.touch == contact::Touch::slip ? 1 : 0;
    for (std::size_t i = 0; i < kMeasured; ++i) finger.in_contact[i].add(values[i]);
  }
  tallyBits(sample.safety, course.safety_before, sample.tick, finger.safety);
  tallyBits(sample.contact.status, course.status_before, sample.tick, finger.contact_status);
  list(course.contacts.add(sample));
  list(course.phases.add(sample.tick, phaseOf(touching, force, speeds.proxy)));
  places_.add(sample);
  if (statistics_.worlds.empty() || statistics_.worlds.back().world != sample.world) {
    statistics_.world_changes += statistics_.worlds.empty() ? 0 : 1;
    if (statistics_.worlds.size() == kMaxListed) statistics_.worlds.pop_back();
    statistics_.worlds.push_back({sample.tick, sample.world});
  }
}

void RecordingMeasurement::list(const std::optional<Contact>& contact) {
  if (!contact) return;
  FingerStatistics& finger = statistics_.fingers[contact->finger];
  ++finger.contacts;
  ++statistics_.contact_count;
  finger.longest_contact_ticks = std::max(finger.longest_contact_ticks, contact->ticks());
  finger.path_mm += contact->path_mm;
  listUpTo(kMaxListed, *contact, statistics_.contacts);
}

void RecordingMeasurement::list(const std::optional<PhaseSpan>& phase) {
  if (!phase) return;
  FingerStatistics& finger = statistics_.fingers[phase->finger];
  const auto kind = static_cast<std::size_t>(phase->phase);
  finger.phase_ticks[kind] += phase->ticks();
  ++finger.phases[kind];
  ++statistics_.phase_count;
  listUpTo(kMaxListed, *phase, statistics_.phases);
}

RecordingStatistics RecordingMeasurement::finish() {
  for (Course& course : courses_) {
    list(course.contacts.finish());
    list(course.phases.finish());
  }
  statistics_.places = places_.places();
  statistics_.places_left_out = places_.leftOut();
  return std::move(statistics_);
}

RecordingStatistics measure(RecordingReader& recording, const TickSpan& span, const Progress& progress) {
  constexpr std::uint64_t kTicksPerReport = 5000;
  const RecordingFacts& facts = recording.facts();
  RecordingMeasurement measurement(facts.fingers.size(), facts.header.ticks_per_s);
  const std::uint64_t first = std::max(facts.first_tick, span.from);
  const std::uint64_t last = std::max(first, std::min(facts.last_tick, span.to));
  std::uint64_t ticks = 0;
  recording.forEachTick(span, [&](std::span<const Sample> samples) {
    measurement.add(samples);
    if (++ticks % kTicksPerReport == 0) {
      const auto done = static_cast<double>(samples.front().tick - std::min(first, samples.front().tick));
      report(progress, "measuring", done / static_cast<double>(last - first + 1));
    }
    return true;
  });
  return measurement.finish();
}

}  // namespace palpate::trace
