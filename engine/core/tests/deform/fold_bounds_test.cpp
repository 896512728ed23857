// The bounds that let a block be passed over: where they say that nothing folds, nothing does.
#include "palpate/deform/fold_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <limits>

#include "core/tests/deform/folded_shapes.h"
#include "core/tests/deform/stage.h"
#include "palpate/deform/fast_displacement.h"
#include "palpate/deform/shear_limit.h"
#include "palpate/mesh/reorder.h"
#include "palpate/tissue/profile.h"

namespace palpate::deform {

using test::press;
using test::Stage;

TEST(FoldBounds, TheProfileIsNowhereSteeper) {
  double steepest = 0.0;
  for (int i = 1; i < 100000; ++i) {
    steepest = std::max(steepest, 1e5 * (tissue::profile(1e-5 * (i - 1)) - tissue::profile(1e-5 * i)));
  }
  EXPECT_LE(steepest, tissue::kProfileSteepest);
  EXPECT_NEAR(steepest, tissue::kProfileSteepest, 1e-6);
}

TEST(FoldBounds, NameTheWidestAngleAndTheCone) {
  const mesh::TriangleMesh grid = zoo::grid(4, 40.0);
  const Skin skin = buildSkin(grid);
  const FoldBound flat = skin.fold_bounds[0];
  EXPECT_NEAR(flat.spread, std::sqrt(2.0), 1e-6);
  // The radius through the corners, and twice the product of the longer sides over the sum of all.
  const double longest = 10.0 * std::sqrt(2.0);
  EXPECT_NEAR(flat.gradient_mm, 0.5 * longest + 2.0 * longest * 10.0 / (20.0 + longest), 1e-4);
  EXPECT_LT(skin.fold_crease[12], 1e-6f);
  EXPECT_EQ(skin.fold_gradient_mm[12], flat.gradient_mm);
  EXPECT_NEAR(flat.cos_cone, 1.0, 1e-5);
  EXPECT_LT((flat.axis - Vec3f::UnitZ()).norm(), 1e-6f);
  const mesh::TriangleMesh sphere = zoo::sphere(20.0, 0);
  EXPECT_LT(buildSkin(sphere).fold_bounds[0].cos_cone, 0.0f);
}

/// Area of a deformed triangle along its rest normal, as a share of its rest area.
double areaLeft(const Stage& stage, Index triangle) {
  const auto& [a, b, c] = stage.skin.triangles[triangle];
  const auto rest = [&](Index v) { return stage.skin.restPosition(v).cast<double>().eval(); };
  const auto now = [&](Index v) { return stage.surface.positionAt(v).cast<double>().eval(); };
  const Vec3 normal = mesh::areaVector2(rest(a), rest(b), rest(c));
  return mesh::areaVector2(now(a), now(b), now(c)).dot(normal) / normal.squaredNorm();
}

/// 100 mm wide, every second one wavy, its vertices moved by up to that share of a side.
mesh::TriangleMesh shakenSheet(int body, double most, Random& random) {
  const bool is_wavy = body % 2 == 0;
  mesh::TriangleMesh mesh = is_wavy ? zoo::wavyGrid(90, 100.0, random.uniform(0.0, 4.0)) : zoo::grid(60, 100.0);
  const double shake = random.uniform(0.0, most) * 100.0 / (is_wavy ? 90 : 60);
  for (Vec3& p : mesh.positions) p += shake * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), 0.0);
  mesh::reorderSpatially(mesh);
  return mesh;
}

/// Calls `visit(vertex, true if it is folded)` for every triangle at a vertex of the block.
template <class Visit>
void forEachTriangleOf(const Stage& stage, Index block, const Visit& visit) {
  const Index end = std::min((block + 1) * kBlockVertices, stage.skin.vertices);
  for (Index v = block * kBlockVertices; v < end; ++v) {
    for (const Index t : stage.skin.triangles_of_vertex[v]) visit(v, areaLeft(stage, t) <= 0.0);
  }
}

// Whole regions only: where skin stays inside an ellipse the bounds say nothing.
TEST(FoldBounds, SayNothingThatTheTrianglesDeny) {
  Random random(5);
  Index certain = 0;
  Index folded_elsewhere = 0;
  for (int body = 0; body < 20; ++body) {
    const mesh::TriangleMesh mesh = shakenSheet(body, 0.45, random);
    Stage stage(mesh, test::formulaeAlone());
    for (int i = 0; i < 10; ++i) {
      Contact contact = press(mesh, test::triangleNear(mesh, {50, 50, 0}), random.uniform(0, 10));
      const double half = random.uniform(10, 40);
      contact.tangential_region = maps::liftedOntoSurface({half, random.uniform(0.5, 1)}, contact.normal);
      contact = test::drag(contact, {random.uniform(-20, 20), random.uniform(-20, 20), 0.0});
      stage.apply({contact});
      const EllipseContact frame = frameOf(contact, {});
      ShearBound shear;
      FastDisplacement::addShear(frame, lanesOf(frame, frame.depth_mm, frame.drag_mm), shear);
      for (Index block = 0; block < stage.skin.blocks; ++block) {
        const bool may_fold = mayFold(stage.skin.fold_bounds[block], shear);
        forEachTriangleOf(stage, block, [&](Index, bool folded) {
          EXPECT_TRUE(!folded || may_fold) << body << " " << i;
          certain += may_fold ? 0 : 1;
          folded_elsewhere += folded ? 1 : 0;
        });
      }
    }
  }
  EXPECT_GT(certain, 100000u);
  EXPECT_GT(folded_elsewhere, 1000u) << "the cases show nothing";
}

/// What the mean of a triangle's slope is off from the slope of a function at its corners, at most.
double slopeOff(const Vec2 (&corner)[3], const std::function<double(const Vec2&)>& value,
                const std::function<Vec2(const Vec2&)>& slope) {
  Mat2 sides;
  sides << (corner[1] - corner[0]).transpose(), (corner[2] - corner[0]).transpose();
  const Vec2 rises(value(corner[1]) - value(corner[0]), value(corner[2]) - value(corner[0]));
  const Vec2 mean = sides.inverse() * rises;
  double off = 0.0;
  for (const Vec2& c : corner) off = std::max(off, (slope(c) - mean).norm());
  return off;
}

// Functions that bend by 1 everywhere and that way or the other, over triangles of every shape.
TEST(FoldBounds, NameHowFarASlopeMayBeOff) {
  Random random(8);
  double nearest = 0.0;
  for (int i = 0; i < 20000; ++i) {
    Vec2 corner[3];
    for (Vec2& c : corner) c = random.uniform2(-1, 1);
    if (i % 3 == 0) corner[2] = corner[0] + 0.05 * corner[2];  // needles
    mesh::TriangleMesh mesh;
    for (const Vec2& c : corner) mesh.positions.emplace_back(c.x(), c.y(), 0.0);
    mesh.triangles = {{0, 1, 2}};
    if (mesh::areaVector2(mesh.positions[0], mesh.positions[1], mesh.positions[2]).norm() < 1e-3) continue;
    const double bound = buildSkin(mesh).fold_bounds[0].gradient_mm;
    const double turn = random.uniform(0.0, 3.2);
    const Vec2 u(std::cos(turn), std::sin(turn));
    const Vec2 v(-u.y(), u.x());
    const Vec2 at = random.uniform2(-1, 1);
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    const auto bent = [](double x) { return 0.5 * x * std::abs(x); };
    const double wave = slopeOff(
        corner, [&](const Vec2& p) { return bent(u.dot(p - at)) + sign * bent(v.dot(p - at)); },
        [&](const Vec2& p) -> Vec2 { return std::abs(u.dot(p - at)) * u + sign * std::abs(v.dot(p - at)) * v; });
    const double saddle = slopeOff(
        corner, [&](const Vec2& p) { return 0.5 * (u.dot(p) * u.dot(p) + sign * v.dot(p) * v.dot(p)); },
        [&](const Vec2& p) -> Vec2 { return u.dot(p) * u + sign * v.dot(p) * v; });
    nearest = std::max({nearest, wave / bound, saddle / bound});
  }
  EXPECT_LE(nearest, 1.0);
  EXPECT_GT(nearest, 0.9) << "the bound is not a close one, or the functions show nothing";
}

// What is left of the area at the vertices settles many of them that the slopes of their block leave in doubt.
TEST(FoldBounds, WithTheAreaAtTheVerticesSayNothingThatTheTrianglesDeny) {
  Random random(6);
  int settled = 0;
  Index folded_elsewhere = 0;
  for (int body = 0; body < 20; ++body) {
    const mesh::TriangleMesh mesh = shakenSheet(body, 0.4, random);
    Stage stage(mesh, test::formulaeAlone());
    for (int i = 0; i < 10; ++i) {
      Contact contact = press(mesh, test::triangleNear(mesh, {50, 50, 0}), random.uniform(0, 10));
      const double half = random.uniform(10, 70);
      if (i % 2 == 0) contact = test::layered(contact, test::bonyShape(random.uniform(20, 80)));
      contact.tangential_region = maps::liftedOntoSurface({half, random.uniform(0.5, 1)}, contact.normal);
      contact = test::drag(contact, {random.uniform(-12, 12), random.uniform(-12, 12), 0.0});
      stage.apply({contact});
      const EllipseContact frame = frameOf(contact, {});
      const ContactLanes lanes = lanesOf(frame, frame.depth_mm, frame.drag_mm);
      ShearBound shear;
      FastDisplacement::addShear(frame, lanes, shear);
      FloatStreams scratch(10, kBlockVertices, 0);
      for (Index block = 0; block < stage.skin.blocks; ++block) {
        DeformedBlock out{};
        out.area = scratch[9];
        for (std::size_t s = 0; s < 9; ++s) out.values[s] = scratch[s];
        const ContactOnBlock on{&lanes, ~std::uint64_t{0}, false};
        displaceBlock({&on, 1}, stage.skin.restBlock(block), out);
        const std::uint64_t doubtful = doubtfulVertices(stage.skin, block, shear, out.area);
        if (mayFold(stage.skin.fold_bounds[block], shear)) settled += 64 - std::popcount(doubtful);
        forEachTriangleOf(stage, block, [&](Index v, bool folded) {
          EXPECT_TRUE(!folded || (doubtful & bitOf(v)) != 0 || stage.moved(v).isZero(0.0)) << body << " " << i;
          folded_elsewhere += folded ? 1 : 0;
        });
      }
    }
  }
  EXPECT_GT(settled, 300 * 64);
  EXPECT_GT(folded_elsewhere, 1000u) << "the cases show nothing";
}

// On a right-angled grid the way along edges is known.
TEST(EdgeDistances, GoAroundWhatIsNotAllowed) {
  const mesh::TriangleMesh grid = zoo::grid(20, 100.0);
  const Skin skin = buildSkin(grid);
  const auto at = [](Index i, Index j) { return 21 * j + i; };
  EdgeDistances distances(skin);
  for (const bool is_walled : {false, true, false}) {
    distances.start();
    distances.seed(at(5, 10), 0.0f);
    distances.spread(skin, 1000.0f, [&](Index v, float) { return !is_walled || v % 21 != 10 || v / 21 == 0; });
    // Back to the gap at j = 0 along the lines, on from there by five diagonals of the cells and five sides.
    EXPECT_NEAR(distances.at(at(15, 10)), is_walled ? 75.0 + 25.0 * std::sqrt(2.0) + 25.0 : 50.0, 1e-3);
    EXPECT_EQ(distances.at(at(10, 10)) < 1e9f, !is_walled);
    EXPECT_EQ(distances.reached().size(), is_walled ? 21u * 20u + 1u : 21u * 21u);
  }
  distances.start();
  distances.seed(at(0, 0), 0.0f);
  distances.spread(skin, 26.0f, [](Index, float) { return true; });
  EXPECT_EQ(distances.at(at(5, 0)), 25.0f);
  EXPECT_GT(distances.at(at(6, 0)), 1e9f);
}

// Of a block of which only the spread is known.
TEST(FoldBounds, CertainSpreadIsWhereABlockBecomesDoubtful) {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    ShearBound shear{.press = random.uniform(0.01, 0.5), .drag = random.uniform(0.0, 0.5)};
    shear.press_bend = shear.drag_bend = 1e9;
    shear.is_one = i % 2 == 0;
    FoldBound block;
    block.gradient_mm = 1.0f;
    block.spread = static_cast<float>(0.999 * certainSpread(shear));
    EXPECT_FALSE(mayFold(block, shear));
    block.spread = static_cast<float>(1.001 * certainSpread(shear));
    EXPECT_TRUE(mayFold(block, shear));
  }
  const double boundless = certainSpread({.press = std::numeric_limits<double>::infinity()});
  EXPECT_FALSE(1.0 < boundless);
}

TEST(FoldBounds, RoomBesideStayingIsAShareOfTheLeastHeight) {
  const mesh::TriangleMesh grid = zoo::grid(4, 40.0);
  const Skin skin = buildSkin(grid);
  for (Index v = 0; v < skin.vertices; ++v) {
    EXPECT_NEAR(skin.room_beside_staying[v], 0.4 * 5.0 * std::sqrt(2.0), 1e-4);
  }
  mesh::TriangleMesh flat = zoo::grid(1, 10.0);
  flat.positions[flat.triangles[0][1]] =
      0.5 * (flat.positions[flat.triangles[0][0]] + flat.positions[flat.triangles[0][2]]);
  EXPECT_EQ(buildSkin(flat).room_beside_staying[flat.triangles[0][0]], 0.0f);
}

// Formulae alone: no vertex beside one that stays unstrained goes beyond the room, and no triangle there turns over.
TEST(FoldBounds, BesideSkinThatIsNotStrainedNothingHasToBeHeld) {
  Random random(8);
  Index unstrained = 0;
  Index strained = 0;
  for (int body = 0; body < 12; ++body) {
    auto mesh = test::lumpyBody(random, 4);
    mesh::reorderSpatially(mesh);
    FormSettings summed = test::formulaeAlone();
    summed.together = Together::summed;
    Stage stage(mesh, summed);
    for (int i = 0; i < 12; ++i) {
      std::vector<Contact> contacts;
      std::vector<ContactLanes> movers;
      for (int n = 0; n <= i % 2; ++n) {
        Contact contact = press(mesh, static_cast<Index>(random.below(mesh.triangles.size())), random.uniform(0, 10));
        if (i % 3 == 0) contact = test::drag(contact, {0, 8, 0});
        const EllipseContact frame = frameOf(contact, {});
        movers.push_back(lanesOf(frame, frame.depth_mm, frame.drag_mm));
        contacts.push_back(contact);
      }
      stage.apply(contacts);
      for (Index v = 0; v < stage.skin.vertices; ++v) {
        if (!stage.moved(v).isZero(0.0)) continue;
        double farthest = 0.0;
        for (const Index w : stage.skin.neighbours[v]) farthest = std::max(farthest, stage.moved(w).norm());
        if (farthest == 0.0) continue;
        const double most = 1.0;
        const std::uint64_t bits = strainedVertices(movers, stage.skin.edgeBlock(blockOf(v)), bitOf(v), most);
        (bits != 0 ? strained : unstrained) += 1;
        if (bits != 0) continue;
        EXPECT_LE(farthest, std::min<double>(most, stage.skin.room_beside_staying[v]) + 2e-4);
        for (const Index t : stage.skin.triangles_of_vertex[v]) EXPECT_GT(areaLeft(stage, t), 0.03);
      }
    }
  }
  EXPECT_GT(unstrained, 100u);
  EXPECT_GT(strained, 100u);
}

}  // namespace palpate::deform
