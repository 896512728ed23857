// Compares a tick through the C interface with the same tick in C++, both in one run and on the same path: press
// 8 mm, drag 20 mm, lift, on the built-in torso. Every output is kept. The forces are compared, too.
//
//   bench_c_api [--json] [--rounds N]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <limits>
#include <string_view>
#include <vector>

#include "palpate.h"
#include "palpate/contact/finger.h"
#include "palpate/engine/fingers.h"
#include "palpate/engine/skin_place.h"
#include "palpate/scene/world.h"

using namespace palpate;

namespace {

struct Settings {
  bool json = false;
  int rounds = 60;
};

/// Down next to T6, towards the head and up again, one tick per ms.
std::vector<Vec3> pressDragLift(const SkinPlace& place) {
  std::vector<Vec3> tips;
  for (int i = 0; i < 400; ++i) tips.push_back(place.point + place.normal * (2.0 - 0.025 * i));
  for (int i = 0; i < 800; ++i) tips.push_back(tips.back() + Vec3(0.0, 0.025, 0.0));
  for (int i = 0; i < 400; ++i) tips.push_back(tips.back() + place.normal * 0.04);
  return tips;
}

/// Nanoseconds a tick.
double timed(std::size_t ticks, const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - start;
  return taken.count() / static_cast<double>(ticks);
}

struct Measured {
  double cpp_ns = std::numeric_limits<double>::infinity();
  double step_ns = std::numeric_limits<double>::infinity();
  double rollout_ns = std::numeric_limits<double>::infinity();
  double contact_share = 0.0;
  bool same_forces = true;
};

bool sameForce(const contact::FingerOutput& cpp, const palpate_touch& c) {
  return cpp.force == Vec3(c.force_n[0], c.force_n[1], c.force_n[2]);
}

/// The best of N rounds of each, in turn: a disturbance hits both alike.
Measured measure(const Settings& settings, palpate_world* world_c) {
  scene::Scene scene;
  scene.body.kind = scene::BodyKind::torso;
  const auto world = scene::build(scene);
  const contact::FingerSettings finger_settings = engine::fingerSettings(scene).front();
  const std::vector<Vec3> tips = pressDragLift(engine::skinPlace(*world, "T6 right 30 mm"));

  std::vector<contact::FingerOutput> felt(tips.size());
  palpate_touch empty = {};
  empty.size = sizeof empty;
  std::vector<palpate_touch> steps(tips.size(), empty);
  std::vector<palpate_touch> rolled(tips.size(), empty);
  palpate_finger* finger = nullptr;
  if (palpate_finger_create(world_c, nullptr, &finger, nullptr) != PALPATE_OK) std::abort();

  Measured measured;
  for (int round = 0; round < settings.rounds; ++round) {
    contact::FingerState state;
    measured.cpp_ns = std::min(measured.cpp_ns, timed(tips.size(), [&] {
                                 for (std::size_t i = 0; i < tips.size(); ++i) {
                                   felt[i] = contact::step(world->surface, finger_settings, state, tips[i]);
                                 }
                               }));
    palpate_finger_lift(finger);
    measured.step_ns = std::min(measured.step_ns, timed(tips.size(), [&] {
                                  for (std::size_t i = 0; i < tips.size(); ++i) {
                                    palpate_finger_step(finger, tips[i].data(), &steps[i]);
                                  }
                                }));
    palpate_finger_lift(finger);
    measured.rollout_ns = std::min(measured.rollout_ns, timed(tips.size(), [&] {
                                     palpate_finger_rollout(finger, tips.front().data(), tips.size(), rolled.data(),
                                                            sizeof(palpate_touch));
                                   }));
  }
  palpate_finger_release(finger);
  std::size_t touching = 0;
  for (std::size_t i = 0; i < tips.size(); ++i) {
    measured.same_forces = measured.same_forces && sameForce(felt[i], steps[i]) && sameForce(felt[i], rolled[i]);
    touching += felt[i].touch != contact::Touch::free ? 1 : 0;
  }
  measured.contact_share = static_cast<double>(touching) / static_cast<double>(tips.size());
  return measured;
}

Settings settingsOf(int argc, char** argv) {
  Settings settings;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == "--json") {
      settings.json = true;
    } else if (word == "--rounds" && i + 1 < argc) {
      settings.rounds = std::max(1, std::atoi(argv[++i]));
    } else {
      std::printf(
          "bench_c_api [--json] [--rounds N]\n"
          "  A tick in C++ and through the C interface, the best of N rounds (60) of 1,600 ticks each, ns.\n"
          "  Ends with 1 where the forces differ in any bit.\n");
      std::exit(word == "--help" ? 0 : 2);
    }
  }
  return settings;
}

}  // namespace

int main(int argc, char** argv) {
  const Settings settings = settingsOf(argc, argv);
  palpate_error error = {};
  error.size = sizeof error;
  palpate_world* world = nullptr;
  if (palpate_world_torso(0, &world, &error) != PALPATE_OK) {
    std::fprintf(stderr, "bench_c_api: %s\n", error.message);
    return 1;
  }
  const Measured measured = measure(settings, world);
  palpate_world_release(world);
  const double over_ns = measured.step_ns - measured.cpp_ns;
  if (settings.json) {
    std::printf(
        "{\"cpp_ns\": %.1f, \"c_step_ns\": %.1f, \"c_over_cpp_ns\": %.1f, \"c_rollout_ns\": %.1f, "
        "\"contact_share\": %.3f, \"same_forces\": %s}\n",
        measured.cpp_ns, measured.step_ns, over_ns, measured.rollout_ns, measured.contact_share,
        measured.same_forces ? "true" : "false");
  } else {
    std::printf(
        "C++ contact::step            %6.1f ns a tick (%.0f %% of them in contact)\n"
        "C   palpate_finger_step      %6.1f ns, %.1f more\n"
        "C   palpate_finger_rollout   %6.1f ns\n"
        "forces: %s\n",
        measured.cpp_ns, 100.0 * measured.contact_share, measured.step_ns, over_ns, measured.rollout_ns,
        measured.same_forces ? "the same, bit by bit" : "NOT the same");
  }
  return measured.same_forces ? 0 : 1;
}
