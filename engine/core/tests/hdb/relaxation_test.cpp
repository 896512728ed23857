// Skin that relaxes through the detecting box is that of the walk over the surface.
#include "palpate/contact/felt_force.h"

#include "core/tests/hdb/hdb_track.h"
#include "palpate/base/random.h"
#include "support/mesh_zoo.h"

namespace palpate::hdb {
namespace {

TEST(HdbRelaxation, IsThatOfTheWalk) {
  FingerSettings settings;
  settings.relaxation = {0.3, 0.1, 0.3, 0.8};
  const HdbBody body(zoo::grid());
  HdbTrack box(body, settings);
  FingerTrack walk(body.surface, settings);
  Random random(3);
  Vec3 tip(50, 50, 3);
  double peak = 0.0;
  int dents = 0;
  for (int tick = 0; tick < 8000; ++tick) {
    const double t = 0.001 * tick;
    tip = {50 + 15 * std::sin(1.1 * t) + random.uniform(-0.01, 0.01), 50 + 10 * std::cos(0.7 * t),
           -1.0 + 5.0 * std::sin(2.3 * t) + 2.0 * std::sin(11.0 * t)};
    const FingerOutput a = box.to(tip);
    const FingerOutput b = walk.to(tip);
    ASSERT_NEAR((a.force - b.force).norm(), 0.0, 1e-5) << tick;
    ASSERT_NEAR(a.rest_mm, b.rest_mm, 1e-5) << tick;
    ASSERT_NEAR(a.dent.rest_mm, b.dent.rest_mm, 1e-5) << tick;
    peak = std::max(peak, b.force.norm());
    dents += b.dent.rest_mm > 0.1 ? 1 : 0;
  }
  EXPECT_GT(peak, 1.0);
  EXPECT_GT(dents, 500);
}

}  // namespace
}  // namespace palpate::hdb
