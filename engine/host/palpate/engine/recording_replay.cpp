#include "palpate/engine/recording_replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <bitset>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/base/path_text.h"
#include "palpate/base/stopwatch.h"
#include "palpate/engine/recording_settings.h"
#include "palpate/scene/scene_file.h"
#include "palpate/trace/recording_edit.h"
#include "palpate/trace/recording_reader.h"
#include "palpate/trace/recording_rest.h"
#include "palpate/trace/sample_block.h"

namespace palpate::engine {

namespace {

/// Finds the samples of a replay that can be proven where a recording lacks time: a finger's memory from there is not
/// known until it has rested (trace/recording_rest.h).
///
///   events "trim", "cut" of the recording ─► ReplayProof ─► compare this sample? forget before it?
///
/// Within a tick first the recorded resets, then the events: a recording that was joined to another begins as one that
/// remembers nothing, and may have been cut itself.
class ReplayProof {
 public:
  explicit ReplayProof(trace::RecordingReader& recording);

  /// The samples of the next tick, before any of them is felt.
  void begin(std::span<const trace::Sample> recorded);
  /// True where a finger of which nothing is known begins to rest: it must be felt as one that has never touched.
  bool isFreshStart(const trace::Sample& recorded);
  /// Whether time before this tick is missing, a device was exchanged, or a finger's press is not known: where lumps
  /// had moved to is not known then.
  bool lostLumps() const { return lost_lumps_ || !knowsAll(); }
  bool knowsAll() const { return std::ranges::all_of(fingers_, &Finger::known); }
  /// Whether the sample must come out to the bit.
  bool proves(const trace::Sample& recorded) const { return fingers_[recorded.finger].known; }
  /// Whether the warning "too stiff" must, too: it counts a second of contact, also across time that is missing.
  bool provesWarnings(const trace::Sample& recorded) const { return fingers_[recorded.finger].counts_known; }

  /// Unproven parts, in words; empty: everything was proven.
  std::vector<std::string> notes() const;
  std::uint64_t unproven() const;

 private:
  struct Finger {
    std::string name;
    bool known = true;
    bool counts_known = true;
    trace::RestWatch rest;
    std::uint64_t unproven = 0;
    std::uint64_t since = 0;  ///< tick of the first of them
  };
  void invalidateFingers(const trace::RecordingEvent& event);

  std::vector<Finger> fingers_;
  std::vector<trace::RecordingEvent> events_;
  std::size_t next_ = 0;
  bool lost_lumps_ = false;
  double ticks_per_s_;
};

ReplayProof::ReplayProof(trace::RecordingReader& recording) : ticks_per_s_(recording.facts().header.ticks_per_s) {
  for (const trace::RecordingFinger& finger : recording.facts().fingers) fingers_.emplace_back().name = finger.name;
  for (trace::RecordingEvent& event : recording.events()) {
    if (event.kind == trace::kTrimEvent || event.kind == trace::kCutEvent || event.kind == trace::kDroppedEvent) {
      events_.push_back(std::move(event));
    }
  }
}

void ReplayProof::invalidateFingers(const trace::RecordingEvent& event) {
  for (std::size_t i = 0; i < fingers_.size(); ++i) {
    if (event.finger && *event.finger != i) continue;
    fingers_[i].counts_known = false;
    if (event.kind == trace::kTrimEvent) continue;
    fingers_[i].known = false;
    fingers_[i].rest = {};
  }
}

void ReplayProof::begin(std::span<const trace::Sample> recorded) {
  lost_lumps_ = false;
  for (const trace::Sample& sample : recorded) {
    Finger& finger = fingers_[sample.finger];
    if ((sample.forgot & trace::kForgotLimiter) == 0) continue;
    lost_lumps_ = true;
    finger.counts_known = true;
    finger.known = finger.known || (sample.forgot & trace::kForgotTouch) != 0;
  }
  for (; next_ < events_.size() && events_[next_].tick <= recorded.front().tick; ++next_) {
    invalidateFingers(events_[next_]);
    lost_lumps_ = true;
  }
}

bool ReplayProof::isFreshStart(const trace::Sample& recorded) {
  Finger& finger = fingers_[recorded.finger];
  if (finger.known) return false;
  finger.known = finger.rest.add(recorded);
  if (!finger.known && finger.unproven++ == 0) finger.since = recorded.tick;
  return finger.rest.ticks() == 1;
}

std::vector<std::string> ReplayProof::notes() const {
  std::vector<std::string> notes;
  for (const Finger& finger : fingers_) {
    if (finger.unproven == 0) continue;
    notes.push_back(fmt::format(
        "{}: {} samples from {:.3f} s on cannot be verified: earlier ticks are missing and the finger was in contact",
        finger.name, finger.unproven, static_cast<double>(finger.since) / ticks_per_s_));
  }
  return notes;
}

std::uint64_t ReplayProof::unproven() const {
  std::uint64_t all = 0;
  for (const Finger& finger : fingers_) all += finger.unproven;
  return all;
}

/// Ticks replayed between two reports of progress.
constexpr std::uint64_t kTicksPerReport = 5000;

std::string valueOf(const trace::SampleColumn& column, std::uint64_t bits) {
  return column.type == "f64" ? fmt::format("{}", std::bit_cast<double>(bits)) : fmt::format("{}", bits);
}

/// Farther than any finger is felt. A lost finger's sample has its last place.
constexpr double kFarAwayMm = 1e12;

Vec3 sampleTip(const trace::Sample& sample) {
  if ((sample.safety & servo::kTipNotFinite) != 0) return device::kNoPlace;
  return (sample.contact.status & contact::kTipLost) != 0 ? Vec3(Vec3::Constant(kFarAwayMm)) : sample.contact.tip;
}

void forget(std::uint32_t bits, servo::FingerChain& chain) {
  if ((bits & trace::kForgotTouch) != 0) forgetTouch(chain);
  if ((bits & trace::kForgotLimiter) == 0) return;
  const bool closes_loop = chain.limiter.closes_loop;  // by the settings
  chain.limiter = {};
  chain.limiter.closes_loop = closes_loop;
}

class Replay {
 public:
  Replay(trace::RecordingReader& recording, const ReplaySettings& settings, const Progress& progress)
      : recording_(recording), settings_(settings), progress_(progress), proof_(recording) {
    fingers_.resize(recording.facts().fingers.size());
  }

  ReplayReport run(const ReplaySink& sink) {
    const trace::TickSpan& span = settings_.span;
    std::vector<trace::Sample> felt;
    recording_.forEachTick({0, span.to}, [&](std::span<const trace::Sample> recorded) {
      felt.clear();
      proof_.begin(recorded);
      // A part of a recording may begin with one finger, and the other may have moved a lump until it comes.
      const bool is_whole = recorded.size() == fingers_.size();
      if (proof_.lostLumps() || !is_whole || !was_whole_) forgetLumps();
      was_whole_ = is_whole;
      for (const trace::Sample& sample : recorded) {
        felt.push_back(recomputeSample(sample));
        if (sample.tick >= span.from && proof_.proves(sample)) compare(sample, felt.back());
      }
      if (sink && recorded.front().tick >= span.from) sink(felt);
      reportProgress(recorded.front().tick);
      return true;
    });
    report_.unproven = proof_.unproven();
    report_.gaps = proof_.notes();
    return std::move(report_);
  }

 private:
  void reportProgress(std::uint64_t tick) {
    if (tick % kTicksPerReport != 0) return;
    const trace::RecordingFacts& facts = recording_.facts();
    const auto all = static_cast<double>(facts.last_tick - facts.first_tick + 1);
    report(progress_, "replaying", static_cast<double>(tick - facts.first_tick) / all);
  }

  /// Recordings that were joined were often felt in one and the same scene.
  std::shared_ptr<const scene::World> reuseOrBuildWorld(const trace::RecordingWorld& recorded,
                                                        const std::filesystem::path& folder) {
    if (worlds_.empty() || built_from_ != std::pair(recorded.scene, folder)) {
      auto world = builtWorld(recorded, folder, progress_);
      built_from_ = {recorded.scene, folder};
      return world;
    }
    return worlds_.back();
  }

  void enter(std::uint32_t number) {
    const trace::RecordingWorld recorded = recording_.world(number);
    if (recorded.fingers.size() != fingers_.size()) {
      throw Error(fmt::format("world {} of the recording has settings for {} fingers; expected {}", number,
                              recorded.fingers.size(), fingers_.size()));
    }
    const auto started = Clock::now();
    const std::filesystem::path folder = settings_.folder.empty() ? pathOf(recorded.folder) : settings_.folder;
    const auto world = reuseOrBuildWorld(recorded, folder);
    report_.build_s += secondsSince(started);
    if (std::string note = noteOfAnotherWorld(recorded, number, *world); !note.empty()) {
      report_.notes.push_back(std::move(note));
    }
    // A damaged file must not leave a finger on a missing triangle.
    const bool other_body =
        worlds_.empty() || world->body->skin.triangles.size() != worlds_.back()->body->skin.triangles.size();
    servo::FingerSolvers solvers = servo::makeSolvers(world->surface, world->hdb, fingers_.size(), world->breath);
    for (std::size_t i = 0; i < fingers_.size(); ++i) {
      servo::FingerChain& chain = fingers_[i];
      if (!worlds_.empty()) {
        servo::exchange(chain.solver, solvers[i], chain.contact);
      } else {
        chain.solver = std::move(solvers[i]);
      }
      if (other_body) forgetTouch(chain);
      chain.contact_settings = contactSettingsFrom(recorded.fingers[i].contact);
      const RecordedLimiter limiter = limiterFrom(recorded.fingers[i].limiter);
      chain.limiter_settings = limiter.settings;
      chain.limiter.closes_loop = limiter.closes_loop;
      chain.solver.handover.follows = limiter.follows_exchange;
    }
    worlds_.push_back(world);  // a solver that was released still points to the one before
    number_ = number;
    if (settings_.entered) settings_.entered(number, world);
  }

  void forgetLumps() {
    lumps_known_.reset();
    lumps_forgotten_ = true;
  }

  /// A lump is at its recorded place, until what moves it is known.
  void placeLump(const trace::Sample& sample, servo::FingerChain& chain) {
    if (chain.solver.lumps && std::exchange(lumps_forgotten_, false)) {
      chain.solver.lumps->forget(*chain.solver.source.surface->lumps);
    }
    const std::size_t lump = sample.contact.lump;
    if (!chain.solver.lumps || lump >= lumps_known_.size()) return;
    if (lumps_known_[lump] && proof_.knowsAll()) return;
    chain.solver.lumps->place(lump, sample.contact.lump_moved_mm);
    lumps_known_.set(lump);
  }

  trace::Sample recomputeSample(const trace::Sample& sample) {
    if (sample.world != number_) enter(sample.world);
    servo::FingerChain& chain = fingers_[sample.finger];
    forget(sample.forgot | (proof_.isFreshStart(sample) ? trace::kForgotTouch | trace::kForgotLimiter : 0u), chain);
    servo::Pose pose;
    pose.tip = sampleTip(sample);
    pose.tick = sample.tick;
    pose.age_ticks = (sample.safety & servo::kTipStale) != 0 ? std::numeric_limits<double>::infinity() : 0.0;
    const Vec3 tip = servo::guardTip(chain.limiter_settings, chain.limiter, pose);
    for (const servo::SafetyBit reported : {servo::kStalled, servo::kEmergencyStop, servo::kClutched}) {
      if ((sample.safety & reported) != 0) servo::reportFault(chain.limiter, reported);
    }
    trace::Sample felt;
    felt.tick = sample.tick;
    felt.finger = sample.finger;
    felt.world = sample.world;
    felt.forgot = sample.forgot;
    felt.buttons = sample.buttons;
    placeLump(sample, chain);
    felt.contact = servo::touch(chain.solver, chain.contact_settings, chain.contact, tip, sample.tick);
    felt.device_force =
        servo::limitForce(chain.limiter_settings, chain.limiter, felt.contact, chain.solver.source.surface->force_law);
    felt.safety = chain.limiter.status;
    felt.loss_n_mm = chain.limiter.passivity.loss_n_mm;
    return felt;
  }

  void compare(const trace::Sample& recorded, trace::Sample felt) {
    ++report_.ticks;
    if (!proof_.provesWarnings(recorded)) {
      felt.safety = (felt.safety & ~servo::kTooStiff) | (recorded.safety & servo::kTooStiff);
    }
    for (const trace::SampleColumn& column : trace::sampleColumns()) {
      const std::uint64_t was = column.bits(recorded);
      const std::uint64_t is = column.bits(felt);
      if (was == is) continue;
      ++report_.different;
      if (!report_.first_difference) {
        report_.first_difference = {recorded.tick, recording_.facts().fingers[recorded.finger].name,
                                    std::string(column.name), valueOf(column, was), valueOf(column, is)};
      }
      return;
    }
  }

  trace::RecordingReader& recording_;
  const ReplaySettings& settings_;
  const Progress& progress_;
  ReplayProof proof_;
  std::vector<servo::FingerChain> fingers_;
  bool was_whole_ = true;                        ///< the last tick had all fingers
  bool lumps_forgotten_ = false;                 ///< and the loop does not know yet
  std::bitset<contact::kMaxLumps> lumps_known_;  ///< none before its place was recorded
  std::vector<std::shared_ptr<const scene::World>> worlds_;
  std::pair<std::string, std::filesystem::path> built_from_;  ///< scene and folder of the last of them
  std::uint32_t number_ = std::numeric_limits<std::uint32_t>::max();
  ReplayReport report_;
};

}  // namespace

ReplayReport replay(trace::RecordingReader& recording, const ReplaySettings& settings, const ReplaySink& sink,
                    const Progress& progress) {
  return Replay(recording, settings, progress).run(sink);
}

std::shared_ptr<const scene::World> builtWorld(const trace::RecordingWorld& recorded,
                                               const std::filesystem::path& folder, const Progress& progress) {
  return scene::build(scene::parse(recorded.scene, (folder / "session.toml").string()), progress);
}

}  // namespace palpate::engine
