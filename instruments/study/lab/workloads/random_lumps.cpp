#include "lab/workloads/random_lumps.h"

#include <algorithm>
#include <utility>

#include "palpate/base/elementary.h"
#include "palpate/tissue/force_law.h"

namespace palpate::lab {

namespace {

contact::Lump makeLump(const tissue::LumpPlace& place, const tissue::LumpShape& shape, const Vec3& foot,
                       const Vec3& axis) {
  contact::Lump lump{.foot = foot, .axis = axis, .energy = place.energyOf(shape), .shape = shape};
  lump.skin_mm = place.stack.layers.front().thickness_mm;
  contact::setPlane(lump);
  return lump;
}

double logUniform(Random& random, double low, double high) {
  return elementary::exp(random.uniform(elementary::log(low), elementary::log(high)));
}

}  // namespace

tissue::LumpPlace randomLumpPlace(Random& random) {
  const double thickness_mm = random.uniform(20.0, 60.0);
  return tissue::libraryPlaceAt(thickness_mm, thickness_mm * random.uniform(0.1, 0.5));
}

contact::Lump randomLump(const tissue::LumpPlace& place, const Vec3& foot, const Vec3& axis, double skin_n_per_mm,
                         Random& random) {
  constexpr double kDeepestMm = 12.0;  // largest depth of the top below the shallowest
  constexpr double kLeftMm = 0.5;
  tissue::LumpShape shape;
  const double across = random.uniform(1.0, 10.0);
  const double into = across * random.uniform(0.5, 1.2);
  shape.half_axes_mm = {across, across, into};
  tissue::TopRange tops = tissue::topRange(shape, place.stack);
  while (tops.to_mm < tops.from_mm + 2.0 * kLeftMm) {
    for (double& half : shape.half_axes_mm) half *= 0.8;
    tops = tissue::topRange(shape, place.stack);
  }
  shape.depth_mm = random.uniform(tops.from_mm + 1e-6, std::min(tops.from_mm + kDeepestMm, tops.to_mm - kLeftMm));
  shape.stiffness_ratio = logUniform(random, 0.2, 100.0);
  shape.edge = random.below(2) == 0 ? 0.0 : random.uniform();
  contact::Lump lump = makeLump(place, shape, foot, axis);
  boundSlope(lump, skin_n_per_mm, false);
  return lump;
}

void loosen(contact::Lump& lump, Random& random) {
  lump.mobility.spring_n_per_mm = logUniform(random, 0.02, 0.3);
  lump.mobility.friction_n = random.uniform(0.0, 0.05);
}

contact::Lump stiffestLump(const Vec3& foot, const Vec3& axis, double skin_n_per_mm) {
  const tissue::LumpPlace place = tissue::libraryPlaceAt(40.0, 8.0);
  tissue::LumpShape shape{.half_axes_mm = {10.0, 10.0, 10.0}, .stiffness_ratio = 1000.0};
  shape.depth_mm = tissue::topRange(shape, place.stack).from_mm + 1e-6;
  contact::Lump lump = makeLump(place, shape, foot, axis);
  boundSlope(lump, skin_n_per_mm, true);
  return lump;
}

void boundSlope(contact::Lump& lump, double skin_n_per_mm, bool stretch) {
  constexpr double kAlways = 0.25;  // share of the skin's own slope
  const tissue::LumpSteepness steepest = lump.energy.steepest();
  const double room = std::max(tissue::kStiffestTissue - skin_n_per_mm, kAlways * skin_n_per_mm);
  const double factor = std::min(room / steepest.depth, tissue::kStiffestTissue / steepest.rho);
  if (stretch || factor < 1.0) lump.energy = lump.energy.scaled(factor);
}

}  // namespace palpate::lab
