// Regions bent by bones and folds, against finite elements that share nothing with them (uneven_bone.json, made by
// tools/solve_uneven_bone.py): radii at which a tenth of a press or a drag is left, direction by direction.
#include "palpate/scene/anatomical_reach.h"
#include "palpate/scene/section_walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "palpate/body/bones.h"
#include "palpate/tissue/layered_library.h"
#include "support/golden.h"

namespace palpate::scene {
namespace {

using Heights = std::vector<double>;  // at x = -100, -99, ... 100

double heightAt(const Heights& heights, double x) {
  const double place = std::clamp(x + 100.0, 0.0, 199.999);
  const auto i = static_cast<std::size_t>(place);
  return heights[i] + (place - static_cast<double>(i)) * (heights[i + 1] - heights[i]);
}

/// The same all along y; facing up.
mesh::TriangleMesh sheet(const Heights& heights, double cell_mm) {
  mesh::TriangleMesh mesh;
  const int cells = static_cast<int>(std::lround(200.0 / cell_mm));
  for (int j = 0; j <= cells; ++j) {
    for (int i = 0; i <= cells; ++i) {
      const double x = -100.0 + cell_mm * i;
      mesh.positions.emplace_back(x, -100.0 + cell_mm * j, heightAt(heights, x));
    }
  }
  const auto row = static_cast<Index>(cells + 1);
  for (Index j = 0; j + 1 < row; ++j) {
    for (Index i = 0; i + 1 < row; ++i) {
      const Index a = j * row + i;
      mesh.triangles.push_back({a, a + 1, a + row + 1});
      mesh.triangles.push_back({a, a + row + 1, a + row});
    }
  }
  return mesh;
}

const tissue::LayeredTissue& layers() {
  static const tissue::LayeredTissue tissue(tissue::libraryNodes(8.0));
  return tissue;
}

/// Skin over one bone, ready to be asked.
struct Ground {
  explicit Ground(const Heights& skin_mm, const Heights& base_mm, double cell_mm = 2.0)
      : heights(skin_mm), skin(sheet(skin_mm, cell_mm)), tree(tree::buildTriangleTree(skin)) {
    bones.push_back({"base", body::BoneKind::rib, sheet(base_mm, 2.0)});
    nearest_mm = body::depthToBones(skin.positions, bones).depth_mm;
  }

  AnatomicalReach reach() const { return {skin, tree, nearest_mm, bones, layers()}; }
  Vec3 normalAt(double x) const {
    return Vec3(heightAt(heights, x - 1.0) - heightAt(heights, x + 1.0), 0.0, 2.0).normalized();
  }
  tree::NearestPoint under(double x) const {
    return tree::nearestPoint(tree, Vec3(x, 0.3, heightAt(heights, x)), 50.0);
  }

  Heights heights;
  mesh::TriangleMesh skin;
  tree::TriangleTree tree;
  std::vector<body::Bone> bones;
  std::vector<double> nearest_mm;
};

/// Root mean squares of the relative errors of radii, with and without the anatomy.
struct Errors {
  double bent = 0.0, flat = 0.0, ellipse = 0.0;
  int count = 0;
  void add(double bent_mm, double ellipse_mm, double flat_mm, double truth_mm) {
    const auto squared = [&](double radius) { return std::pow(std::log(radius / truth_mm), 2.0); };
    bent += squared(bent_mm);
    ellipse += squared(ellipse_mm);
    flat += squared(flat_mm);
    ++count;
  }
  static double root(double sum, int count) { return std::sqrt(sum / count); }
};

/// Radii of the truth over flat ground of this thickness.
std::vector<double> flatRadii(const std::string& load, double thickness) {
  const nlohmann::json rows = test::goldenRows("uneven_bone", "flat");
  std::size_t above = 1;
  while (above + 1 < rows.size() && rows[above]["thickness"].get<double>() < thickness) ++above;
  const double low = rows[above - 1]["thickness"].get<double>();
  const double high = rows[above]["thickness"].get<double>();
  const double share = std::clamp(std::log(thickness / low) / std::log(high / low), 0.0, 1.0);
  std::vector<double> radii;
  for (std::size_t i = 0; i < rows[above][load].size(); ++i) {
    const double first = rows[above - 1][load][i].get<double>();
    radii.push_back(first + share * (rows[above][load][i].get<double>() - first));
  }
  return radii;
}

/// The ellipse of flat radii of the truth: along x at 0, along y at 90 degree.
maps::SurfaceEllipse flatEllipse(const std::vector<double>& radii, const Vec3& tangent) {
  const bool along_x = radii[0] >= radii[3];
  const Vec3 axis = along_x ? Vec3(radii[0] * tangent) : Vec3(radii[3] * Vec3::UnitY());
  return {axis, std::min(radii[0], radii[3]) / std::max(radii[0], radii[3])};
}

struct Loads {
  const char* name;
  bool press = false;
  bool along_y = false;
};
constexpr Loads kPress{"press_tenth", true};
constexpr Loads kQuarter{"press_quarter", true};
constexpr Loads kDragX{"drag_x_tenth"};
constexpr Loads kDragY{"drag_y_tenth", false, true};

void judge(const Ground& ground, const AnatomicalReach& reach, const nlohmann::json& load, const Loads& kind,
           Errors& errors) {
  const double x = load["x"].get<double>();
  const tree::NearestPoint at = ground.under(x);
  const Index triangle = ground.tree.source_triangle[at.triangle];
  const double thickness = body::depthToBones(std::vector<Vec3>{at.closest.point}, ground.bones).depth_mm.front();
  const std::vector<double> flat = flatRadii(kind.name, thickness);
  const Vec3 normal = ground.normalAt(x);
  const Vec3 tangent = Vec3::UnitY().cross(normal);
  const maps::SurfaceEllipse region = flatEllipse(flat, tangent);
  const tissue::PressCurves curves = layers().pressAt(thickness, 8.0);
  ReachRequest request{.press = kind.press ? &curves : nullptr};
  if (!kind.press) {
    request.drag_tenth = region;
    request.drag = kind.along_y ? Vec3::UnitY() : tangent;
  }
  const PlaceReach place = reach.at(ground.tree, triangle, at.closest.point, normal, request);
  const DirectedFactors& factors = kind.press ? place.press : place.drag;
  const maps::SurfaceContour contour = bentContour(region, factors, place);
  const maps::SurfaceEllipse ellipse = bentEllipse(region, factors, place);
  for (std::size_t i = 0; i < flat.size(); ++i) {
    const double angle = 30.0 * kRadPerDeg * static_cast<double>(i);
    const Vec3 ahead = std::cos(angle) * tangent + std::sin(angle) * Vec3::UnitY();
    errors.add(1.0 / maps::locationRatio(contour, ahead), 1.0 / maps::locationRatio(ellipse, ahead),
               1.0 / maps::locationRatio(region, ahead), load[kind.name][i].get<double>());
  }
}

/// Over the named cases, each load at each place.
Errors rmsErrors(const std::vector<std::string>& names, const std::vector<Loads>& kinds) {
  Errors errors;
  for (const nlohmann::json& row : test::goldenRows("uneven_bone", "cases")) {
    if (std::find(names.begin(), names.end(), row["name"].get<std::string>()) == names.end()) continue;
    const Ground ground(row["skin_mm"].get<Heights>(), row["base_mm"].get<Heights>());
    const AnatomicalReach reach = ground.reach();
    for (const nlohmann::json& load : row["loads"]) {
      for (const Loads& kind : kinds) judge(ground, reach, load, kind, errors);
    }
  }
  errors = {Errors::root(errors.bent, errors.count), Errors::root(errors.flat, errors.count),
            Errors::root(errors.ellipse, errors.count), errors.count};
  return errors;
}

/// The rules were chosen on these ...
const std::vector<std::string> kBones = {"rib", "step", "spine"};
const std::vector<std::string> kFolds = {"furrow", "cleft"};
/// ... and not on these.
const std::vector<std::string> kHeldBack = {"ribs", "seam"};

TEST(AnatomicalReach, APressOverUnevenBoneReachesAsFiniteElementsHaveIt) {
  for (const Loads& kind : {kPress, kQuarter}) {
    const Errors errors = rmsErrors(kBones, {kind});
    EXPECT_LT(errors.bent, 0.035) << kind.name;
    EXPECT_LT(errors.ellipse, 0.055) << kind.name << ": the part that an ellipse can have";
    EXPECT_GT(errors.flat, 2.0 * errors.bent) << kind.name;
  }
}

TEST(AnatomicalReach, ADragOverUnevenBoneReachesAsFiniteElementsHaveIt) {
  const Errors errors = rmsErrors(kBones, {kDragX, kDragY});
  EXPECT_LT(errors.bent, 0.11);
  EXPECT_LT(errors.ellipse, 0.13);
  EXPECT_GT(errors.flat, 1.5 * errors.bent);
}

TEST(AnatomicalReach, ADragEndsAtAFold) {
  const Errors errors = rmsErrors(kFolds, {kDragX, kDragY});
  EXPECT_LT(errors.bent, 0.13);
  EXPECT_LT(errors.ellipse, 0.28) << "an ellipse has to be short on both sides";
  EXPECT_GT(errors.flat, 3.0 * errors.bent);
}

TEST(AnatomicalReach, HoldsWhereItsRulesWereNotChosen) {
  for (const Loads& kind : {kPress, kQuarter, kDragX, kDragY}) {
    const Errors errors = rmsErrors(kHeldBack, {kind});
    EXPECT_LT(errors.bent, 0.8 * errors.flat) << kind.name << ' ' << errors.bent;
  }
}

TEST(AnatomicalReach, FlatSkinOverEvenTissueKeepsItsRegions) {
  for (const double cell : {2.0, 10.0}) {
    const Ground ground(Heights(201, 0.0), Heights(201, -30.0), cell);
    const AnatomicalReach reach = ground.reach();
    const tissue::PressCurves curves = layers().pressAt(30.0, 8.0);
    const tree::NearestPoint at = ground.under(3.0);
    const maps::SurfaceEllipse drag{Vec3(20.0, 50.0, 0.0), 0.7};
    const PlaceReach place = reach.at(ground.tree, ground.tree.source_triangle[at.triangle], at.closest.point,
                                      Vec3::UnitZ(), {.press = &curves, .drag_tenth = drag});
    for (std::size_t i = 0; i < place.press.size(); ++i) {
      EXPECT_NEAR(place.press[i], 0.0, 0.01) << i;
      EXPECT_NEAR(place.drag[i], 0.0, 0.01) << i;
    }
    const maps::SurfaceEllipse bent = bentEllipse(drag, place.drag, place);
    EXPECT_NEAR(std::abs(bent.half_major.dot(drag.half_major)) / drag.half_major.squaredNorm(), 1.0, 0.01);
    EXPECT_NEAR(bent.aspect, 0.7, 0.01);
  }
}

/// Towards thicker tissue a press reaches farther, as a multiple of what it reaches where it is.
TEST(AnatomicalReach, TheThinnestTissueHasItsOwnReach) {
  const double thinnest = layers().thinnest();
  const auto farthest = [&](double thickness) {
    Heights base(201, -1.5 * thinnest);
    std::fill(base.begin(), base.begin() + 100, -thickness);
    const Ground ground(Heights(201, 0.0), base);
    const tissue::PressCurves curves = layers().pressAt(thickness, 8.0);
    const tree::NearestPoint at = ground.under(-5.0);
    return std::ranges::max(ground.reach()
                                .at(ground.tree, ground.tree.source_triangle[at.triangle], at.closest.point,
                                    Vec3::UnitZ(), {.press = &curves})
                                .press);
  };
  EXPECT_GT(farthest(thinnest), farthest(1.02 * thinnest));
}

TEST(AnatomicalReach, TissueOfOneStackReachesAlikeEverywhere) {
  tissue::LayeredNode node = tissue::libraryNodes(8.0)[2];
  node.thickness_mm = 20.0;
  const tissue::LayeredTissue one_stack({node});
  const Ground ground(Heights(201, 0.0), Heights(201, -20.0), 10.0);
  const AnatomicalReach reach(ground.skin, ground.tree, ground.nearest_mm, ground.bones, one_stack);
  const tissue::PressCurves curves = one_stack.pressAt(20.0, 8.0);
  const tree::NearestPoint at = tree::nearestPoint(ground.tree, Vec3::Zero(), 50.0);  // a vertex: 20 mm to the bit
  const PlaceReach place = reach.at(ground.tree, ground.tree.source_triangle[at.triangle], at.closest.point,
                                    Vec3::UnitZ(), {.press = &curves});
  for (const double factor : place.press) EXPECT_NEAR(factor, 0.0, 1e-6);
}

TEST(AnatomicalReach, ReliefIsNoFold) {
  Heights relief;
  for (int x = -100; x <= 100; ++x) relief.push_back(0.3 * std::sin(x / 3.0));
  const Ground ground(relief, Heights(201, -30.0));
  const tree::NearestPoint at = ground.under(0.0);
  const PlaceReach place = ground.reach().at(ground.tree, ground.tree.source_triangle[at.triangle], at.closest.point,
                                             Vec3::UnitZ(), {.drag_tenth = {Vec3(60.0, 0.0, 0.0), 1.0}});
  for (const double factor : place.drag) EXPECT_GT(factor, -0.1);
}

TEST(AnatomicalReach, ChangesSteadilyAlongTheSkin) {
  for (const nlohmann::json& row : test::goldenRows("uneven_bone", "cases")) {
    if (row["name"] == "cleft") continue;  // its walls face each other: there a drag ends at once or not at all
    const Ground ground(row["skin_mm"].get<Heights>(), row["base_mm"].get<Heights>());
    const AnatomicalReach reach = ground.reach();
    const tissue::PressCurves curves = layers().pressAt(20.0, 8.0);
    PlaceReach before;
    for (double x = -30.0; x <= 30.0; x += 0.25) {
      const tree::NearestPoint at = ground.under(x);
      const PlaceReach place =
          reach.at(ground.tree, ground.tree.source_triangle[at.triangle], at.closest.point, ground.normalAt(x),
                   {.press = &curves, .drag_tenth = {Vec3(50.0, 0.0, 0.0), 1.0}});
      for (std::size_t i = 0; x > -30.0 && i < place.press.size(); ++i) {
        EXPECT_NEAR(place.press[i], before.press[i], 0.05) << row["name"] << ' ' << x << ' ' << i;
        EXPECT_NEAR(place.drag[i], before.drag[i], 0.25) << row["name"] << ' ' << x << ' ' << i;
      }
      before = place;
    }
  }
}

TEST(SectionWalk, GoesAheadFromACornerWhicheverOfItsTrianglesIsNamed) {
  const Ground ground(Heights(201, 0.0), Heights(201, -30.0), 10.0);
  const Index corner = 21 * 8 + 9;
  int named = 0;
  for (Index record = 0; record < ground.tree.records.size(); ++record) {
    const std::array<Index, 3>& vertices = ground.tree.records[record].vertices;
    if (std::find(vertices.begin(), vertices.end(), corner) == vertices.end()) continue;
    ++named;
    for (int degree = 0; degree < 360; degree += 15) {
      const Vec3 ahead(std::cos(degree * kRadPerDeg), std::sin(degree * kRadPerDeg), 0.0);
      const Vec3& from = ground.skin.positions[corner];
      SectionWalk walk(ground.tree, record, from, Vec3::UnitZ(), ahead);
      SectionWalk::Crossing crossing;
      for (int i = 0; i < 8; ++i) ASSERT_TRUE(walk.next(crossing));
      EXPECT_GT((crossing.point - from).dot(ahead), 10.0) << record << ' ' << degree;
    }
  }
  EXPECT_EQ(named, 6);
}

TEST(SectionWalk, GoesStraightAheadAndEndsAtTheBorder) {
  const Ground ground(Heights(201, 0.0), Heights(201, -30.0), 10.0);
  const tree::NearestPoint at = ground.under(1.0);
  const Vec3 ahead = Vec3(1.0, 0.4, 0.0).normalized();
  SectionWalk walk(ground.tree, at.triangle, at.closest.point, Vec3::UnitZ(), ahead);
  SectionWalk::Crossing crossing;
  double before = 0.0;
  int crossings = 0;
  while (walk.next(crossing)) {
    const Vec3 offset = crossing.point - at.closest.point;
    EXPECT_GE(offset.dot(ahead), before - 1e-9);
    EXPECT_NEAR((offset - offset.dot(ahead) * ahead).norm(), 0.0, 0.01);
    before = offset.dot(ahead);
    ++crossings;
  }
  EXPECT_NEAR(crossing.point.x(), 100.0, 1e-9);
  EXPECT_GT(crossings, 15);
}

}  // namespace
}  // namespace palpate::scene
