// Own.
#include "palpate/engine/session_replay.h"

#include <fmt/format.h>

#include <bit>
#include <limits>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/stopwatch.h"
#include "palpate/engine/replay_proof.h"
#include "palpate/engine/session_settings.h"
#include "palpate/scene/scene_file.h"
#include "palpate/trace/sample_block.h"

namespace palpate::engine {

namespace {

/// How many ticks are replayed between two reports of progress.
constexpr std::uint64_t kTicksPerReport = 5000;

std::string valueOf(const trace::SampleColumn& column, std::uint64_t bits) {
  return column.type == "f64" ? fmt::format("{}", std::bit_cast<double>(bits)) : fmt::format("{}", bits);
}

/// Farther than any finger is felt. A lost finger's sample says where it was before.
constexpr double kFarAwayMm = 1e12;

Vec3 tipOf(const trace::Sample& sample) {
  if ((sample.safety & servo::kTipNotFinite) != 0) return device::kNoPlace;
  return (sample.contact.status & contact::kTipLost) != 0 ? Vec3(Vec3::Constant(kFarAwayMm)) : sample.contact.tip;
}

void forget(std::uint32_t bits, servo::FingerChain& chain) {
  if ((bits & trace::kForgotTouch) != 0) forgetTouch(chain);
  if ((bits & trace::kForgotLimiter) == 0) return;
  const bool closes_loop = chain.limiter.closes_loop;  // as the settings say
  chain.limiter = {};
  chain.limiter.closes_loop = closes_loop;
}

class Replay {
 public:
  Replay(trace::SessionReader& session, const ReplaySettings& settings, const Progress& progress)
      : session_(session), settings_(settings), progress_(progress), proof_(session) {
    fingers_.resize(session.facts().fingers.size());
  }

  ReplayReport run(const ReplaySink& sink) {
    const trace::TickSpan& span = settings_.span;
    std::vector<trace::Sample> felt;
    session_.forEachTick({0, span.to}, [&](std::span<const trace::Sample> recorded) {
      felt.clear();
      proof_.begin(recorded);
      for (const trace::Sample& sample : recorded) {
        felt.push_back(feelAgain(sample));
        if (sample.tick >= span.from && proof_.proves(sample)) compare(sample, felt.back());
      }
      if (sink && recorded.front().tick >= span.from) sink(felt);
      tellProgress(recorded.front().tick);
      return true;
    });
    report_.unproven = proof_.unproven();
    report_.gaps = proof_.notes();
    return std::move(report_);
  }

 private:
  void tellProgress(std::uint64_t tick) {
    if (tick % kTicksPerReport != 0) return;
    const trace::SessionFacts& facts = session_.facts();
    const auto all = static_cast<double>(facts.last_tick - facts.first_tick + 1);
    report(progress_, "replaying", static_cast<double>(tick - facts.first_tick) / all);
  }

  /// Sessions that were joined were often felt in one and the same scene.
  std::shared_ptr<const scene::World> worldOf(const trace::SessionWorld& recorded,
                                              const std::filesystem::path& folder) {
    if (worlds_.empty() || built_from_ != std::pair(recorded.scene, folder)) {
      auto world = builtWorld(recorded, folder, progress_);
      built_from_ = {recorded.scene, folder};
      return world;
    }
    return worlds_.back();
  }

  void enter(std::uint32_t number) {
    const trace::SessionWorld recorded = session_.world(number);
    if (recorded.fingers.size() != fingers_.size()) {
      throw Error(fmt::format("world {} of the session has settings for {} fingers instead of {}", number,
                              recorded.fingers.size(), fingers_.size()));
    }
    const auto started = Clock::now();
    const std::filesystem::path folder =
        settings_.folder.empty() ? std::filesystem::path(recorded.folder) : settings_.folder;
    const auto world = worldOf(recorded, folder);
    report_.build_s += secondsSince(started);
    if (hashOf(*world) != recorded.hash) {
      report_.notes.push_back(fmt::format(
          "world {} is not the recorded one: its body or its stiffness is another ({} triangles instead of {})", number,
          world->body->skin.triangles.size(), recorded.triangles));
    }
    // A file that somebody bent must not leave a finger on a triangle that there is none of.
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
    worlds_.push_back(world);  // a solver that was put down still points to the one before
    number_ = number;
  }

  trace::Sample feelAgain(const trace::Sample& sample) {
    if (sample.world != number_) enter(sample.world);
    servo::FingerChain& chain = fingers_[sample.finger];
    forget(sample.forgot | (proof_.beginsAnew(sample) ? trace::kForgotTouch | trace::kForgotLimiter : 0u), chain);
    servo::Pose pose;
    pose.tip = tipOf(sample);
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
    felt.contact = servo::touch(chain.solver, chain.contact_settings, chain.contact, tip, sample.tick);
    felt.device_force =
        servo::limitForce(chain.limiter_settings, chain.limiter, felt.contact, chain.solver.surface->force_law);
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
        report_.first_difference = {recorded.tick, session_.facts().fingers[recorded.finger].name,
                                    std::string(column.name), valueOf(column, was), valueOf(column, is)};
      }
      return;
    }
  }

  trace::SessionReader& session_;
  const ReplaySettings& settings_;
  const Progress& progress_;
  ReplayProof proof_;
  std::vector<servo::FingerChain> fingers_;
  std::vector<std::shared_ptr<const scene::World>> worlds_;
  std::pair<std::string, std::filesystem::path> built_from_;  ///< scene and folder of the last of them
  std::uint32_t number_ = std::numeric_limits<std::uint32_t>::max();
  ReplayReport report_;
};

}  // namespace

ReplayReport replay(trace::SessionReader& session, const ReplaySettings& settings, const ReplaySink& sink,
                    const Progress& progress) {
  return Replay(session, settings, progress).run(sink);
}

std::shared_ptr<const scene::World> builtWorld(const trace::SessionWorld& recorded, const std::filesystem::path& folder,
                                               const Progress& progress) {
  return scene::build(scene::parse(recorded.scene, (folder / "session.toml").string()), progress);
}

}  // namespace palpate::engine
