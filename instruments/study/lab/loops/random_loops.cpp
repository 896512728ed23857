// Spread of the hands: 95 % of 15 people, Fu and Cavusoglu 2012, as quoted by others; where it is not known, +-30 %.
#include "lab/loops/random_loops.h"

#include <array>

namespace palpate::lab {

namespace {

double jittered(Random& random, double value) { return value * random.uniform(0.7, 1.3); }

device::HandModel anyHand(Random& random) {
  using device::HandKind;
  switch (random.below(5)) {
    case 0:
      return handLike(HandKind::stylus_x, random);
    case 1:
      return handLike(HandKind::stylus_z, random);
    default:
      break;
  }
  constexpr std::array kOthers{HandKind::stylus_y, HandKind::thimble, HandKind::arm};
  return handLike(kOthers[random.below(kOthers.size())], random);
}

const device::DeviceProfile& nominal(std::size_t number) {
  static const std::vector<device::DeviceProfile> profiles = [] {
    std::vector<device::DeviceProfile> all;
    for (const scene::DeviceModel model : nominalDevices()) all.push_back(device::profileOf(model));
    return all;
  }();
  return profiles[number % profiles.size()];
}

}  // namespace

device::HandModel handLike(device::HandKind kind, Random& random) {
  using device::HandKind;
  device::HandModel hand = device::handModel(kind);
  switch (kind) {
    case HandKind::stylus_x:
      return {random.uniform(0.14, 0.57), random.uniform(63e-3, 151e-3), random.uniform(3.7e-3, 10.3e-3),
              random.uniform(228e-3, 651e-3), random.uniform(0.87e-3, 4.6e-3)};
    case HandKind::stylus_z:
      return {jittered(random, hand.mass_kg), random.uniform(214e-3, 533e-3), random.uniform(13e-3, 28e-3),
              random.uniform(679e-3, 1043e-3), random.uniform(0.0, 1.4e-3)};
    default:
      break;
  }
  for (double* value : {&hand.mass_kg, &hand.stiffness_n_per_mm, &hand.damping_n_s_per_mm, &hand.grip_n_per_mm,
                        &hand.grip_damping_n_s_per_mm}) {
    *value = jittered(random, *value);
  }
  return hand;
}

const std::vector<scene::DeviceModel>& nominalDevices() {
  using scene::DeviceModel;
  static const std::vector<DeviceModel> all{DeviceModel::omni,        DeviceModel::touch_x, DeviceModel::premium_1_5,
                                            DeviceModel::premium_3_0, DeviceModel::falcon,  DeviceModel::omega_3,
                                            DeviceModel::inverse3};
  return all;
}

LoopPlan randomLoop(const RandomCell& cell, std::uint64_t number) {
  Random random(number * 2654435761u + 17);
  LoopPlan plan;
  plan.believed = &nominal(number);
  plan.device = *plan.believed;
  plan.device.mass_kg = jittered(random, plan.device.mass_kg);
  plan.device.damping_n_s_per_mm *= random.uniform(0.1, 2.0);
  plan.device.friction_n *= random.uniform(0.5, 1.5);
  plan.amplifier_lag_s = random.uniform(0.0, 0.0005);
  plan.jitter_ticks = random.uniform(0.0, 0.25);
  plan.hand = anyHand(random);
  if (cell.dead_load) plan.hand = device::handModel(device::HandKind::dead_load);
  plan.delay_ticks = cell.delay_ticks;
  plan.protection = cell.protection;
  plan.plate.stiffness_n_per_mm = cell.stiffness_n_per_mm;
  plan.plate.lumps = cell.lumps;
  plan.seed = number + 1;
  return plan;
}

std::size_t oscillating(const RandomCell& cell, std::size_t systems) {
  std::size_t count = 0;
  for (std::size_t number = 0; number < systems; ++number) {
    const LoopPlan plan = randomLoop(cell, number);
    count += kick(plan).oscillates(plan.device.encoder_mm) ? 1 : 0;
  }
  return count;
}

}  // namespace palpate::lab
