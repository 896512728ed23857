// One replay for all fingers; a pattern costs about as much as a tick.
#include "palpate/engine/recorded_pressure.h"

#include <memory>
#include <optional>
#include <span>

#include "palpate/engine/felt_pressure.h"

namespace palpate::engine {

RecordedPressure recordedPressure(trace::RecordingReader& recording, const ReplaySettings& settings,
                                  const contact::PressurePad& pad, const Progress& progress) {
  checkPad(pad);
  RecordedPressure recorded;
  recorded.taxels = pad.taxels;
  recorded.kpa.resize(recording.facts().fingers.size());
  ReplaySettings felt_again = settings;
  std::optional<FeltPressure> pressure;
  felt_again.entered = [&](std::uint32_t number, const std::shared_ptr<const scene::World>& world) {
    if (settings.entered) settings.entered(number, world);
    if (!pressure || pressure->world() != world) pressure.emplace(world);
  };
  std::vector<double> kpa(pad.taxels * pad.taxels);
  recorded.replay = replay(
      recording, felt_again,
      [&](std::span<const trace::Sample> felt) {
        for (const trace::Sample& sample : felt) {
          pressure->at(sample.contact, sample.tick, pad, kpa);
          std::vector<float>& of_finger = recorded.kpa[sample.finger];
          for (const double taxel : kpa) of_finger.push_back(static_cast<float>(taxel));
        }
      },
      progress);
  return recorded;
}

}  // namespace palpate::engine
