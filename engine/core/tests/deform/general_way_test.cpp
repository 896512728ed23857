// Every form of the dissertation: Deformer where it displaces the general way, and when it does. What it promises in
// each of them stands in every_way_test.cpp.
#include <gtest/gtest.h>

#include <cmath>

#include "core/tests/deform/golden_grid.h"
#include "core/tests/deform/scalar_reference.h"
#include "core/tests/deform/stage.h"

namespace palpate::deform {

using test::anyContact;
using test::anyFormedContact;
using test::bits;
using test::drag;
using test::FormStage;
using test::literally;
using test::press;
using test::triangleNear;

void expectGoldenGrid(FormStage& stage, const std::string& mode) {
  for (const auto& c : test::goldenRows("fsmd_grid", "cases")) {
    if (c["mode"] != mode) continue;
    stage.apply({test::goldenContact(stage.mesh, c)});
    std::vector<bool> listed(stage.skin.vertices, false);
    for (const auto& v : c["vertices"]) {
      const auto index = v["index"].get<Index>();
      listed[index] = true;
      EXPECT_LT((stage.surface.positionAt(index).cast<double>() - test::vec3(v["position"])).norm(), 1e-5) << v;
    }
    Index moved = 0;
    for (Index v = 0; v < stage.skin.vertices; ++v) {
      const bool moves = !stage.moved(v).isZero(0.0);
      moved += moves ? 1 : 0;
      EXPECT_TRUE(listed[v] || !moves) << c["name"] << " " << v;
    }
    EXPECT_EQ(moved, c["moved_count"]) << c["name"];
  }
}

TEST(GeneralWay, DeformsTheReferenceGrid) {
  FormStage stage(test::goldenGrid());
  expectGoldenGrid(stage, "recommended");
}

// (4.13), 700 entries with nearest lookup, rings as printed; the reference caps the drag's length (E19).
TEST(GeneralWay, DeformsTheReferenceGridAsTheDissertationDoes) {
  FormStage stage(test::goldenGrid(), literally({Erratum::E14_location_ratio, Erratum::E18_profile_rim,
                                                 Erratum::E21_press_region, Erratum::E23_region_search}));
  expectGoldenGrid(stage, "dissertation");
}

TEST(GeneralWay, EachErratumAloneMissesTheDissertationsGrid) {
  const auto c = test::goldenRows("fsmd_grid", "cases")[4];
  ASSERT_EQ(c["mode"], "dissertation");
  const auto worst = [&](const FormSettings& forms) {
    FormStage stage(test::goldenGrid(), forms);
    stage.apply({test::goldenContact(stage.mesh, c)});
    double distance = 0.0;
    for (const auto& v : c["vertices"]) {
      distance =
          std::max(distance, (stage.surface.positionAt(v["index"]).cast<double>() - test::vec3(v["position"])).norm());
    }
    return distance;
  };
  EXPECT_LT(worst(literally({Erratum::E14_location_ratio, Erratum::E18_profile_rim})), 1e-5);
  EXPECT_GT(worst(literally({Erratum::E14_location_ratio})), 0.03);
  EXPECT_GT(worst(literally({Erratum::E18_profile_rim})), 0.1);
  EXPECT_GT(worst(literally({Erratum::E14_location_ratio, Erratum::E15_aspect, Erratum::E18_profile_rim})), 1.0);
  EXPECT_GT(worst(literally({Erratum::E14_location_ratio, Erratum::E18_profile_rim, Erratum::E19_drag_cap})), 1.0);
}

// The general deformer and the kernels are two programs for one definition.
TEST(GeneralWay, WithDefaultFormsIsTheFastOne) {
  for (auto& mesh : {lab::backMesh(6261), test::torso()}) {
    FormSettings forms = test::formulaeAlone();
    forms.common.strain = true;
    FormStage general(mesh, forms);
    Deformer fast(general.skin, forms.common);
    DeformedSurface expected(general.skin);
    Random random(23);
    for (int i = 0; i < 60; ++i) {
      const std::vector<Contact> contacts{anyContact(mesh, random), anyContact(mesh, random)};
      const Report report = general.apply(contacts);
      const Report fast_report = fast.apply(contacts, expected);
      EXPECT_EQ(report.status, fast_report.status);
      EXPECT_NEAR(report.moved_vertices, fast_report.moved_vertices, 2) << "the rim is a matter of rounding";
      for (Index v = 0; v < general.skin.vertices; ++v) {
        ASSERT_LT((general.surface.positionAt(v) - expected.positionAt(v)).norm(), 1e-4f) << i << " " << v;
        ASSERT_LT((general.surface.displacementAt(v) - expected.displacementAt(v)).norm(), 1e-4f) << i << " " << v;
        ASSERT_LT((general.surface.normalAt(v) - expected.normalAt(v)).norm(), 2e-3f) << i << " " << v;
        ASSERT_NEAR(general.surface.strain()[v], expected.strain()[v], 1e-4f) << i << " " << v;
      }
    }
  }
}

// ---- single forms -----------------------------------------------------------------------------------------------

/// A press with radius 40 in the middle of a flat sheet with vertices 5 mm apart.
struct Sheet : FormStage {
  explicit Sheet(const FormSettings& forms = {}) : FormStage(zoo::grid(40, 200.0), forms) {
    contact = press(mesh, triangleNear(mesh, {100, 100, 0}), 6.0, Vec3(1, 0, 0));
    contact.normal_region = maps::liftedOntoSurface(maps::Ellipse{40.0, 1.0}, contact.normal);
  }
  /// Location ratio in the press.
  double ratio(Index v) const { return (test::restPoint(skin, v) - contact.anchor).head<2>().norm() / 40.0; }
  Contact contact;
};

TEST(GeneralWay, PressesInTheShapeOfTheProfile) {
  for (const auto kind : {tissue::ProfileKind::table, tissue::ProfileKind::sharp, tissue::ProfileKind::cosine,
                          tissue::ProfileKind::logarithm, tissue::ProfileKind::two_gaussians}) {
    FormSettings forms;
    forms.normal_profile.kind = kind;
    Sheet sheet(forms);
    sheet.apply({sheet.contact});
    const tissue::ProfileCurve curve(forms.normal_profile);
    for (Index v = 0; v < sheet.skin.vertices; ++v) {
      EXPECT_NEAR(sheet.moved(v).z(), -6.0 * curve.at(sheet.ratio(v)).value, 1e-5);
    }
  }
}

TEST(GeneralWay, PressAndDragHaveProfilesOfTheirOwn) {
  FormSettings forms;
  forms.tangential_profile.kind = tissue::ProfileKind::power;
  Sheet sheet(forms);
  Contact contact = drag(sheet.contact, {4, 0, 0});
  contact.tangential_region = contact.normal_region;
  sheet.apply({contact});
  const tissue::ProfileCurve power(forms.tangential_profile);
  const tissue::ProfileCurve half_gaussian;
  for (Index v = 0; v < sheet.skin.vertices; ++v) {
    EXPECT_NEAR(sheet.moved(v).x(), 4.0 * power.at(sheet.ratio(v)).value, 1e-5);
    EXPECT_NEAR(sheet.moved(v).z(), -6.0 * half_gaussian.at(sheet.ratio(v)).value, 1e-5);
  }
}

TEST(GeneralWay, RadialTermPullsTowardsTheFinger) {
  FormSettings forms;
  forms.radial.share = 0.08;
  Sheet sheet(forms);
  sheet.apply({sheet.contact});
  double largest = 0.0;
  for (Index v = 0; v < sheet.skin.vertices; ++v) {
    const Vec3 offset = test::restPoint(sheet.skin, v) - sheet.contact.anchor;
    const double inward = offset.norm() > 0.0 ? -sheet.moved(v).dot(offset.normalized()) : 0.0;
    EXPECT_NEAR(inward, 6.0 * tissue::radialPull(forms.radial, sheet.ratio(v)).value, 1e-4);
    largest = std::max(largest, inward);
  }
  EXPECT_NEAR(largest, 0.08 * 6.0, 0.02);
}

TEST(GeneralWay, ContourBoundsTheDrag) {
  FormSettings forms;
  forms.shape = Shape::contour;
  Sheet sheet(forms);
  Contact contact = drag(sheet.contact, {5, 0, 0});
  contact.depth_mm = 0.0;
  const auto contour = maps::contourOf(std::vector<double>{60, 20, 30, 25, 45, 35});
  contact.tangential_contour = maps::contourOnSurface(contour, contact.normal);
  sheet.apply({contact});
  for (Index v = 0; v < sheet.skin.vertices; ++v) {
    const Vec3 offset = test::restPoint(sheet.skin, v) - contact.anchor;
    const double expected = 5.0 * tissue::profile(maps::locationRatio(contour, offset.head<2>()));
    EXPECT_NEAR(sheet.moved(v).x(), expected, 1e-5);
  }
}

TEST(GeneralWay, CircleHasTheEllipsesArea) {
  FormSettings forms;
  forms.shape = Shape::circle;
  Sheet sheet(forms);
  Contact contact = drag(sheet.contact, {5, 0, 0});
  contact.tangential_region = maps::liftedOntoSurface(maps::Ellipse{50.0, 0.5, 0.3}, contact.normal);
  sheet.apply({contact});
  for (Index v = 0; v < sheet.skin.vertices; ++v) {
    const double q = (test::restPoint(sheet.skin, v) - contact.anchor).norm() / (50.0 * std::sqrt(0.5));
    EXPECT_NEAR(sheet.moved(v).x(), 5.0 * tissue::profile(q), 1e-5);
  }
}

// Two fingers 20 mm apart, each 5 mm deep: added up, the skin under each sinks deeper than its finger.
TEST(GeneralWay, PlainSumSinksTooDeep) {
  const auto depth = [](Together together) {
    FormSettings forms;
    forms.together = together;
    Sheet sheet(forms);
    Contact second = sheet.contact;
    second.anchor.x() += 20.0;
    second.anchor_triangle = triangleNear(sheet.mesh, second.anchor);
    sheet.apply({sheet.contact, second});
    return -sheet.moved(sheet.mesh.triangles[sheet.contact.anchor_triangle][0]).z();
  };
  EXPECT_NEAR(depth(Together::solved), 6.0, 1e-4);
  EXPECT_NEAR(depth(Together::summed), 6.0 * (1.0 + tissue::profile(0.5)), 1e-4);
}

TEST(GeneralWay, LiteralCapsActOnComponents) {  // E19
  Sheet sheet(literally({Erratum::E19_drag_cap}));
  const Index centre = sheet.mesh.triangles[sheet.contact.anchor_triangle][0];
  sheet.apply({drag(sheet.contact, {18, 24, 0})});
  EXPECT_LT((sheet.moved(centre) - Vec3(18, 20, -6)).norm(), 1e-4);
  Sheet corrected;
  corrected.apply({drag(corrected.contact, {18, 24, 0})});
  EXPECT_LT((corrected.moved(centre) - Vec3(12, 16, -6)).norm(), 1e-4);
}

TEST(GeneralWay, LiteralNegativeDepthPullsOut) {  // E19
  Sheet sheet(literally({Erratum::E19_drag_cap}));
  sheet.contact.depth_mm = -3.0;
  sheet.apply({sheet.contact});
  EXPECT_NEAR(sheet.moved(sheet.mesh.triangles[sheet.contact.anchor_triangle][0]).z(), 3.0, 1e-5);
  Sheet corrected;
  corrected.contact.depth_mm = -3.0;
  EXPECT_EQ(corrected.apply({corrected.contact}).moved_vertices, 0u);
}

// The printed rings know no facing test: an ellipse as wide as the body drags the belly along (E23).
TEST(GeneralWay, LiteralRingsReachTheFarSide) {
  const auto far_moves = [](const FormSettings& forms) {
    FormStage stage(test::torso(), forms);
    Contact contact = press(stage.mesh, triangleNear(stage.mesh, {0, 0, 100}), 5.0);
    contact.tangential_region = maps::liftedOntoSurface(maps::Ellipse{300.0, 1.0}, contact.normal);
    stage.apply({drag(contact, {10, 0, 0})});
    Index far = 0;
    for (Index v = 0; v < stage.skin.vertices; ++v) {
      far += stage.skin.restNormal(v).z() < 0.0f && !stage.moved(v).isZero(0.0) ? 1 : 0;
    }
    return far;
  };
  EXPECT_EQ(far_moves({}), 0u);
  EXPECT_GT(far_moves(literally({Erratum::E23_region_search})), 500u);
}

// All corners of the anchor's triangle outside: printed, the search is over; the vertex beyond them is never seen.
TEST(GeneralWay, LiteralRingsStopEarlyOnCoarseMeshes) {
  const mesh::TriangleMesh strip{{{0, 0, 0}, {100, 0, 0}, {0, 100, 0}, {55, 55, 0}}, {{0, 1, 2}, {1, 3, 2}}};
  const auto moved = [&](const FormSettings& forms) {
    FormStage stage(strip, forms);
    Contact contact = press(stage.mesh, 0, 5.0, Vec3(0.1, 0.45, 0.45));
    contact.normal_region.half_major = Vec3(20, 0, 0);
    return stage.apply({contact}).moved_vertices;
  };
  EXPECT_EQ(moved({}), 1u);
  EXPECT_EQ(moved(literally({Erratum::E23_region_search})), 0u);
}

TEST(GeneralWay, SearchIsTheOneOfTheFastPath) {
  const auto mesh = test::torso();
  const Skin skin = buildSkin(mesh);
  Deformer deformer(skin, test::formulaeAlone(), Way::general);
  DeformedSurface surface(skin);
  Random random(19);
  for (int i = 0; i < 40; ++i) {
    const Contact contact = anyContact(mesh, random);
    const auto expected = test::displacementsOf(skin, test::scalarContact(contact));
    deformer.apply({&contact, 1}, surface);
    for (Index v = 0; v < skin.vertices; ++v) {
      ASSERT_LT((surface.displacementAt(v).cast<double>() - expected[v]).norm(), 1e-5) << i << " " << v;
    }
  }
}

// The surface normal of the deformed smooth sheet, from neighbours half a millimetre apart, in every shape and profile.
TEST(GeneralWay, AnalyticNormalsAreThoseOfTheSurface) {
  std::vector<FormSettings> all = test::manyForms();
  for (FormSettings& forms : all) {
    if (forms.fidelity.literal(Erratum::E18_profile_rim)) continue;  // the stored table is a staircase
    forms.common.normals = Normals::analytic;
    FormStage stage(zoo::grid(200, 100.0), forms);
    Contact contact = press(stage.mesh, triangleNear(stage.mesh, {50, 50, 0}), 5.0);
    contact.normal_region = maps::liftedOntoSurface(maps::Ellipse{35.0, 0.8, 0.4}, contact.normal);
    contact.tangential_region = maps::liftedOntoSurface(maps::Ellipse{40.0, 0.7, 1.0}, contact.normal);
    const std::vector<double> radii{40, 30, 35, 28, 38, 33, 36, 31};
    contact.tangential_contour = maps::contourOnSurface(maps::contourOf(radii), contact.normal);
    stage.apply({drag(contact, {5, 3, 0})});
    double sum = 0.0;
    Index count = 0;
    for (Index v = 0; v < stage.skin.vertices; ++v) {
      if (stage.moved(v).isZero(0.0)) continue;
      const PositionStreams places{stage.surface.position(0).data(), stage.surface.position(1).data(),
                                   stage.surface.position(2).data()};
      sum += (stage.surface.normalAt(v) - areaWeightedNormal(stage.skin, places, v)).norm();
      ++count;
    }
    EXPECT_LT(sum / count, 4e-3);
  }
}

// ---- the octree as a search -------------------------------------------------------------------------------------

TEST(OctreeSearch, OnOpenSkinDisplacesAsNeighboursDo) {
  const auto mesh = lab::backMesh(8163);
  FormSettings octree = test::formulaeAlone();
  octree.search = Search::octree;
  FormStage found(mesh, octree);
  FormStage expected(mesh, test::formulaeAlone());
  Random random(5);
  for (int i = 0; i < 20; ++i) {
    const Contact contact = anyFormedContact(mesh, random);
    const Report report = found.apply({contact});
    EXPECT_EQ(report.moved_vertices, expected.apply({contact}).moved_vertices);
    EXPECT_EQ(bits(found.surface), bits(expected.surface));
    EXPECT_LT(report.visited_vertices, found.skin.vertices) << "not all are asked";
  }
}

// It knows places and not who hangs together (E23): why the engine's own search goes along the skin.
TEST(OctreeSearch, TakesTheOtherFingerToo) {
  const Contact contact = [] {
    const auto mesh = test::twoFingers();
    return press(mesh, triangleNear(mesh, {-9.5, 60, 8}), 10.0);
  }();
  for (const Search search : {Search::neighbours, Search::octree}) {
    FormSettings forms;
    forms.search = search;
    FormStage stage(test::twoFingers(), forms);
    stage.apply({contact});
    double other = 0.0;
    for (Index v = 0; v < stage.skin.vertices; ++v) {
      if (stage.mesh.positions[v].x() > 0.0) other = std::max(other, stage.moved(v).norm());
    }
    EXPECT_EQ(other > 1.0, search == Search::octree) << other;
  }
}

// ---- the choice -------------------------------------------------------------------------------------------------

TEST(ChosenWay, IsTheFastOneUnlessAFormNeedsTheGeneralOne) {
  const mesh::TriangleMesh grid = zoo::grid(4, 100.0);
  const Skin skin = buildSkin(grid);
  EXPECT_TRUE(Deformer(skin).isFast());
  FormSettings regions;
  regions.region = NormalRegion::constant;
  regions.boundary = Boundary::two_mm;
  regions.common.strain = true;
  regions.common.normals = Normals::recomputed;
  regions.fidelity.setLiteral(Erratum::E21_press_region);
  EXPECT_TRUE(Deformer(skin, regions).isFast()) << "regions come with the contacts";
  const auto all = test::manyForms();
  for (std::size_t i = 1; i < all.size(); ++i) {
    if (i != 9) {
      EXPECT_FALSE(Deformer(skin, all[i]).isFast()) << i;
    }
  }
}

TEST(ChosenWay, DoesWhatItsChoiceDoes) {
  const auto mesh = lab::backMesh(2962);
  const Skin skin = buildSkin(mesh);
  Random random(2);
  const Contact contact = anyFormedContact(mesh, random);
  for (const FormSettings& forms : {test::manyForms()[0], test::manyForms()[1]}) {
    Deformer any(skin, forms);
    DeformedSurface surface(skin);
    DeformedSurface expected(skin);
    const Report report = any.apply({&contact, 1}, surface);
    const bool fast = any.isFast();
    Deformer same = fast ? Deformer(skin, forms.common) : Deformer(skin, forms, Way::general);
    EXPECT_EQ(same.apply({&contact, 1}, expected).moved_vertices, report.moved_vertices);
    EXPECT_EQ(bits(surface), bits(expected));
  }
}

}  // namespace palpate::deform
