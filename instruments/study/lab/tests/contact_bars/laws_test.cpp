// The contact bars under every force law, layered tissue first: over a back whose tissue is thin over the spine and the
// ribs and thick beside them.
#include <numbers>

#include "lab/tests/contact_bars/bars.h"
#include "palpate/tissue/layered_library.h"
#include "palpate/tissue/layered_tissue.h"

namespace palpate::bars {
namespace {

using tissue::ForceLaw;

constexpr double kFatMm = 8.0;

const tissue::LayeredTissue& layers() {
  static const tissue::LayeredTissue layered = [] {
    std::vector<tissue::LayeredNode> nodes = tissue::libraryNodes(kFatMm);
    for (tissue::LayeredNode& node : nodes) node = tissue::softenedTo(tissue::kStiffestTissue, std::move(node));
    return tissue::LayeredTissue(std::move(nodes));
  }();
  return layered;
}

/// A furrow of 12 mm over the spine that is 50 mm deep beside it, with ribs 25 mm apart.
double thicknessAt(const Vec3& place) {
  const double aside = (place.x() - 0.5 * lab::kBackWidthMm) / 40.0;
  const double between_ribs = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * place.y() / 25.0);
  return 12.0 + (1.0 - std::exp(-aside * aside)) * (10.0 + 28.0 * between_ribs);
}

/// The law where every vertex has its thickness and the stiffness that its layers have at 8 mm.
template <class Thickness>
void setLaw(bench::ContactWorld& world, ForceLaw::Kind kind, const Thickness& thickness_at) {
  contact::Surface& surface = world.surface;
  surface.force_law = {.kind = kind};
  if (kind != ForceLaw::Kind::layered) return;
  surface.force_law.layers = layers().forceRows();
  const mesh::TriangleMesh mesh = bench::extractMesh(surface);
  std::vector<double> stiffness;
  std::vector<double> thickness;
  for (const Vec3& place : mesh.positions) {
    thickness.push_back(thickness_at(place));
    stiffness.push_back(layers().secantAt(thickness.back(), tissue::kReferenceDepthMm));
  }
  surface = contact::buildSurface(mesh, stiffness, {.force_law = surface.force_law, .tissue_mm = thickness});
}

void setLaw(bench::ContactWorld& world, ForceLaw::Kind kind) { setLaw(world, kind, thicknessAt); }

constexpr bench::Window kSlide{lab::kSlideFromSeconds, lab::kSlideUntilSeconds};

/// What every slide over layered tissue must be; its largest force step over its largest force.
double expectKept(bench::ContactWorld& world, double radius_mm, double most_step_n) {
  const bench::ContactFigures figures = measure(world, "back_slide", radius_mm, kSlide);
  EXPECT_EQ(figures.falls.ticks, 0u) << radius_mm;
  EXPECT_EQ(figures.contact_ticks, figures.ticks) << radius_mm;
  EXPECT_LE(figures.max_force_step_n, most_step_n) << radius_mm << " at tick " << figures.max_force_step_tick;
  support::expectNone(figures.counts.allocations, "layered");
  // Layers push a sphere of half a millimetre, as one of 1 mm, back with a quarter of what a point, which counts as a
  // fingertip, feels.
  const bool is_small = radius_mm > 0.0 && radius_mm < 2.0;
  EXPECT_GT(figures.peak_force_n, is_small ? 1.0 : 4.0) << "the path shows nothing";
  return figures.max_force_step_n / figures.peak_force_n;
}

// The bar of slide_test.cpp is for a point; a fingertip is pushed back twice as hard at the depth of its centre.
TEST(Laws, LayeredTissueOfOneThicknessKeepsTheBarsOfTheBack) {
  for (const char* back : {"back_8163", "back_41582"}) {
    for (const double thickness_mm : {40.0, 25.0}) {
      bench::ContactWorld world = makeBarWorld(back);
      setLaw(world, ForceLaw::Kind::layered, [&](const Vec3&) { return thickness_mm; });
      for (const double radius_mm : radiiMm()) expectKept(world, radius_mm, radius_mm < 1.0 ? 0.45 : 0.55);
    }
  }
}

// Bone 12 mm under the skin pushes a point back with 11 N and a fingertip with 27: a step may be as large a part of
// that as 0.45 N is of the 5 N of the usual bar.
TEST(Laws, LayeredTissueOverBonesNeverLosesTheFingerAndStepsNoMoreThanItsForce) {
  for (const char* back : {"back_8163", "back_41582"}) {
    bench::ContactWorld world = makeBarWorld(back);
    setLaw(world, ForceLaw::Kind::layered);
    for (const double radius_mm : radiiMm()) EXPECT_LE(expectKept(world, radius_mm, 1.2), 0.45 / 5.0) << radius_mm;
  }
}

class FrictionUnderLaw : public testing::TestWithParam<ForceLaw::Kind> {};

TEST_P(FrictionUnderLaw, IsExact) {
  bench::ContactWorld world = makeBarWorld("flat100");
  setLaw(world, GetParam());
  for (const double radius_mm : {0.0, 8.0}) {
    const bench::FrictionFigures friction = measure(world, "flat_fric_20", radius_mm).friction;
    EXPECT_GT(friction.slip_ticks, 50u);
    EXPECT_NEAR(friction.kinetic_min, 0.44, 1e-4);
    EXPECT_NEAR(friction.kinetic_max, 0.44, 1e-4);
    EXPECT_LE(friction.static_peak, 0.46 + 1e-6);
    EXPECT_GE(friction.static_peak, 0.455);
  }
}

// Down to 10 mm and up again at 1 mm/s, on skin without friction: what the hand gives it gets back.
TEST_P(FrictionUnderLaw, AQuietPressGivesItsEnergyBack) {
  bench::ContactWorld world = makeBarWorld("back_8163");
  setLaw(world, GetParam());
  for (const double radius_mm : {0.0, 8.0}) {
    for (const Vec2& at : {Vec2(175, 200), Vec2(190, 210), Vec2(240, 120), Vec2(100, 262)}) {
      const Vec3 above(at.x(), at.y(), 300.0);
      const tree::Crossing hit = tree::firstFrontCrossing(world.surface.geometry->tree, above, above - Vec3(0, 0, 600));
      contact::FingerSettings settings = makeBarFinger(radius_mm);
      settings.mu_static = settings.mu_dynamic = 0.0;
      contact::FingerState state;
      double given = 0.0;
      double most = 0.0;
      Vec3 before_force = Vec3::Zero();
      Vec3 before_tip = hit.point + Vec3(0, 0, radius_mm + 1.0);
      for (int tick = 0; tick <= 22000; ++tick) {
        const double depth = tick <= 11000 ? tick / 1000.0 - 1.0 : 21.0 - tick / 1000.0;
        const Vec3 tip = hit.point + Vec3(0, 0, radius_mm - depth);
        const contact::FingerOutput felt = contact::step(world.surface, settings, state, tip);
        given -= 0.5 * (felt.force + before_force).dot(tip - before_tip);
        most = std::max(most, given);
        before_force = felt.force;
        before_tip = tip;
      }
      EXPECT_GT(most, 1.0);
      EXPECT_NEAR(given, 0.0, 0.01 * most) << at.transpose() << ", radius " << radius_mm;
    }
  }
}

std::string nameOf(const testing::TestParamInfo<ForceLaw::Kind>& kind) {
  constexpr const char* kNames[] = {"linear", "power", "stiffening", "table", "layered"};
  return kNames[static_cast<std::size_t>(kind.param)];
}

INSTANTIATE_TEST_SUITE_P(Every, FrictionUnderLaw,
                         testing::Values(ForceLaw::Kind::linear, ForceLaw::Kind::power, ForceLaw::Kind::stiffening,
                                         ForceLaw::Kind::layered),
                         nameOf);

}  // namespace
}  // namespace palpate::bars
