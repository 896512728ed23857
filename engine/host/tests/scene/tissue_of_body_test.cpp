// Layers over the bones of the default body: where it lies thick and thin, what that makes of a press and of a drag.
#include "palpate/scene/tissue_of_body.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <functional>

#include "palpate/body/places.h"
#include "palpate/scene/healthy_tissue.h"
#include "palpate/scene/skin_contact.h"
#include "palpate/tissue/force_law.h"
#include "palpate/tissue/layered_library.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"

namespace palpate::scene {
namespace {

std::shared_ptr<const World> trunk(const std::function<void(Scene&)>& change = [](Scene&) {}) {
  Scene scene;
  scene.body.triangles = 20000;
  scene.deformation.tissue = TissueModel::layered;
  change(scene);
  return build(scene);
}

/// The vertex of the back nearest to a place in words.
Index vertexAt(const World& world, const std::string& words) {
  const Vec3 place = body::placeNamed(world.body->anatomy.landmarks, words).point;
  Index nearest = 0;
  for (Index v = 0; v < world.body->skin.positions.size(); ++v) {
    if ((world.body->skin.positions[v] - place).norm() < (world.body->skin.positions[nearest] - place).norm())
      nearest = v;
  }
  return nearest;
}

/// A finger that presses and drags at a vertex.
contact::FingerOutput fingerAt(const World& world, Index vertex, double depth_mm, const Vec3& drag_mm = Vec3::Zero()) {
  contact::FingerOutput finger;
  for (Index t = 0; t < world.body->skin.triangles.size(); ++t) {
    const Triangle& corners = world.body->skin.triangles[t];
    if (std::find(corners.begin(), corners.end(), vertex) != corners.end()) finger.anchor_triangle = t;
  }
  finger.triangle = finger.anchor_triangle;
  finger.anchor = world.body->skin.positions[vertex];
  finger.proxy = finger.anchor + drag_mm;
  finger.normal = Vec3::UnitZ();
  finger.depth_mm = depth_mm;
  finger.touch = contact::Touch::stick;
  return finger;
}

TEST(LayeredBody, IsOneWithBonesThatNoOtherFormIsAskedFor) {
  EXPECT_TRUE(trunk()->layered);
  EXPECT_FALSE(trunk([](Scene& s) { s.deformation.tissue = TissueModel::gaussian; })->layered);
  EXPECT_FALSE(trunk([](Scene& s) { s.deformation.tissue = TissueModel::literal; })->layered);
  EXPECT_FALSE(trunk([](Scene& s) { s.fidelity.setAll(true); })->layered);
  EXPECT_FALSE(trunk([](Scene& s) { s.deformation.forms.normal_profile.kind = tissue::ProfileKind::cosine; })->layered);
  EXPECT_FALSE(trunk([](Scene& s) { s.deformation.forms.common.tissue.normal_radius_mm = 20.0; })->layered);
}

TEST(LayeredBody, WithoutLayersFeelsAsItDidBefore) {
  const auto world = trunk([](Scene& s) { s.deformation.tissue = TissueModel::gaussian; });
  EXPECT_EQ(tissue::normalForce(world->surface.force_law, 0.5, 3.0), 1.5) << "Hooke's law";
  const std::vector<double> map = maps::stiffnessFromDepth(world->body->anatomy.depth_mm, world->scene.stiffness.depth);
  EXPECT_EQ(*world->surface.stiffness_n_per_mm, map);
}

TEST(LayeredBody, PushesBackAsTheSolvedStackOfThePlace) {
  const auto world = trunk([](Scene& s) { s.tissue.narrow_bone = false; });
  const tissue::LayeredTissue library(tissue::libraryNodes(fatOf(world->scene)));
  for (const char* place : {"T6", "T9 right 32 mm", "L3", "L3 right 40 mm", "T4 left 60 mm"}) {
    const Index v = vertexAt(*world, place);
    const double thickness = std::clamp(world->body->anatomy.depth_mm[v], library.thinnest(), library.thickest());
    EXPECT_EQ(world->surface.tissue_mm[v], thickness);
    for (const double depth : {2.0, 5.0, 7.5, 10.0}) {
      const double felt =
          tissue::normalForce(world->surface.force_law, (*world->surface.stiffness_n_per_mm)[v], depth, thickness);
      const double solved = depth * library.secantAt(thickness, depth);
      EXPECT_NEAR(felt / solved, 1.0, thickness < 12.0 && depth > 7.0 ? 0.25 : 0.05) << place << " " << depth << " mm";
    }
  }
}

TEST(LayeredBody, ThinTissueIsStifferAndItsDentNarrower) {
  const auto world = trunk();
  const Index bony = vertexAt(*world, "T6");
  const Index soft = vertexAt(*world, "L3 right 40 mm");
  ASSERT_LT(world->surface.tissue_mm[bony] + 10.0, world->surface.tissue_mm[soft]);
  EXPECT_GT((*world->surface.stiffness_n_per_mm)[bony], 1.3 * (*world->surface.stiffness_n_per_mm)[soft]);
  const auto width_at = [&](Index v) {
    const deform::Contact contact = contactOf(*world, fingerAt(*world, v, 8.0)).value();
    const tissue::PressCurves& press = contact.layered.value().press;
    double q = 0.0;
    while (tissue::curveAt(press.down, tissue::kPressBend, q * q).value > 0.5) q += 0.001;
    return q * press.radius_mm;
  };
  EXPECT_LT(width_at(bony), 0.9 * width_at(soft));
}

TEST(LayeredBody, TheSkinNeverGoesDownToTheBone) {
  const auto world = trunk();
  for (const char* place : {"T1", "T6", "L3", "T4 left 60 mm"}) {
    const Index v = vertexAt(*world, place);
    const deform::Contact contact = contactOf(*world, fingerAt(*world, v, 60.0)).value();
    EXPECT_LE(contact.depth_mm, 0.9 * world->surface.tissue_mm[v] + 1e-9) << place;
  }
}

TEST(LayeredBody, MoreBodyMassIsMoreFatAndSofterUnderALightTouch) {
  Scene scene;
  EXPECT_NEAR(fatOf(scene), 8.5, 0.5);
  scene.body.shape.body_mass_index = 30.0;
  EXPECT_NEAR(fatOf(scene), 15.4, 0.5);
  scene.body.shape.body_mass_index = 45.0;
  EXPECT_EQ(fatOf(scene), 25.0);
  scene.tissue.fat_mm = 12.0;
  EXPECT_EQ(fatOf(scene), 12.0) << "the scene's own number";
  const auto force = [](double fat) {
    return tissue::LayeredTissue(tissue::libraryNodes(fat)).secantAt(50.0, 3.0) * 3.0;
  };
  EXPECT_LT(force(20.0), 0.85 * force(4.0));
}

TEST(LayeredBody, ADragAlongTheSpineFollowsTheMeasuredEllipseAndOneAcrossTurnsIt) {
  const auto world = trunk();
  const Index v = vertexAt(*world, "T6");
  const deform::Contact up = contactOf(*world, fingerAt(*world, v, 5.0, {0.0, 10.0, 0.0})).value();
  const maps::SurfaceEllipse measured = world->ellipses.on(up.anchor, up.normal);
  const double tenth_q = world->layered->dragAt(world->surface.tissue_mm[v]).tenth_q;
  const double rim = std::min(measured.half_major.norm() / tenth_q, 160.0);
  EXPECT_NEAR(up.tangential_region.half_major.norm(), rim, 0.01) << "as far as the flanks allow";
  EXPECT_NEAR(up.tangential_region.aspect, measured.aspect, 1e-3);
  const deform::Contact aside = contactOf(*world, fingerAt(*world, v, 5.0, {10.0, 0.0, 0.0})).value();
  const auto reach = [](const maps::SurfaceEllipse& e, const Vec3& along) {
    const double a = e.half_major.norm();
    const double s = along.dot(e.half_major) / a;
    return 1.0 / std::hypot(s / a, std::sqrt(std::max(0.0, 1.0 - s * s)) / (a * e.aspect));
  };
  const auto elongation = [&](const deform::Contact& contact) {
    return reach(contact.tangential_region, Vec3::UnitX()) / reach(contact.tangential_region, Vec3::UnitY());
  };
  EXPECT_GT(elongation(aside), 1.5 * elongation(up)) << "longer along the drag";
}

/// Where a tenth of the drag is left, as a location ratio.
double findTenthFallOff(const tissue::LayeredCurve& drag) {
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 50; ++i) {
    const double q = 0.5 * (low + high);
    (tissue::curveAt(drag, tissue::kDragBend, q * q).value > 0.1 ? low : high) = q;
  }
  return low;
}

// What `palpate measure session` writes: a trunk with a person's own points, and the 2 mm contour as the boundary.
TEST(LayeredBody, OfAMeasuredPersonHasLayersBonesAndTheEllipsesThatWereMeasured) {
  const auto average = trunk();
  const Vec3 t6 = body::placeNamed(average->body->anatomy.landmarks, "T6").point;
  const Vec3 flank = body::placeNamed(average->body->anatomy.landmarks, "L3 right 60").point;
  support::TemporaryFolder folder;
  std::ofstream(folder / "person.csv") << "name,x_mm,y_mm,half_major_mm,major_over_minor,direction_deg\n"
                                       << fmt::format("P1,{},{},72,1.4,25\n", t6.x(), t6.y())
                                       << fmt::format("P2,{},{},105,1.25,80\n", flank.x(), flank.y());
  const auto person = trunk([&](Scene& scene) {
    scene.ellipses.key_points = folder / "person.csv";
    scene.deformation.forms.boundary = deform::Boundary::two_mm;
  });
  ASSERT_TRUE(person->layered);
  const auto force = [](const World& world, const char* words) {
    const Index v = vertexAt(world, words);
    return tissue::normalForce(world.surface.force_law, (*world.surface.stiffness_n_per_mm)[v], 5.0,
                               world.surface.tissue_mm[v]);
  };
  const double bony = force(*person, "T6") / force(*person, "L3 right 60");
  EXPECT_GT(bony, 2.0);
  EXPECT_NEAR(bony, force(*average, "T6") / force(*average, "L3 right 60"), 0.1 * bony);
  const std::pair<const char*, double> measured[] = {{"T6", 72.0}, {"L3 right 60", 105.0}};
  for (const auto& [words, half_major_mm] : measured) {
    const auto contact = contactOf(*person, fingerAt(*person, vertexAt(*person, words), 5.0, {0, 20, 0}));
    ASSERT_TRUE(contact);
    const double tenth = contact->tangential_region.half_major.norm() * findTenthFallOff(contact->layered->drag);
    EXPECT_NEAR(tenth, half_major_mm, 0.02 * half_major_mm) << words;
  }
}

TEST(LayeredBody, PushesBackOnAFingerByItsRadiusUnlessTheSceneSaysNo) {
  const auto forces = [](const World& world) {
    const Index vertex = vertexAt(world, "T9 right 30 mm");
    const double tissue_mm = world.surface.tissue_mm[vertex];
    std::vector<double> felt;
    for (const double radius : {0.0, 4.0, 8.0, 12.0}) {
      felt.push_back(tissue::normalForce(world.surface.force_law, (*world.surface.stiffness_n_per_mm)[vertex], 5.0,
                                         {tissue_mm, radius}));
    }
    return felt;
  };
  const auto felt = forces(*trunk());
  EXPECT_EQ(felt[0], felt[2]) << "a point is felt as a fingertip";
  EXPECT_LT(felt[1], 0.75 * felt[2]);
  EXPECT_GT(felt[3], 1.2 * felt[2]);
  const auto alike = forces(*trunk([](Scene& s) { s.tissue.by_finger_radius = false; }));
  EXPECT_EQ(alike, std::vector<double>(4, felt[2]));
  const auto point = forces(*trunk([](Scene& s) { s.tissue.point_radius_mm = 4.0; }));
  EXPECT_EQ(point[0], felt[1]);
  EXPECT_EQ(point[2], felt[2]);
}

TEST(LayeredBody, NarrowBoneIsFeltSofterAndWideBoneAsItWas) {
  const auto wide = trunk([](Scene& s) { s.tissue.narrow_bone = false; });
  const auto narrow = trunk();
  const auto force = [](const World& world, const std::string& place) {
    const Index vertex = vertexAt(world, place);
    return tissue::normalForce(world.surface.force_law, (*world.surface.stiffness_n_per_mm)[vertex], 5.0,
                               tissue::PressedPlace{world.surface.tissue_mm[vertex], 8.0});
  };
  EXPECT_LT(force(*narrow, "T6"), 0.9 * force(*wide, "T6")) << "a spinous process";
  EXPECT_GT(force(*narrow, "T6"), 0.5 * force(*wide, "T6"));
  for (Index v = 0; v < wide->body->skin.positions.size(); ++v) {
    ASSERT_GE(narrow->surface.tissue_mm[v], wide->surface.tissue_mm[v]);
    const bool deep = wide->body->anatomy.depth_mm[v] > 30.0;
    ASSERT_TRUE(!deep || (*narrow->surface.stiffness_n_per_mm)[v] == (*wide->surface.stiffness_n_per_mm)[v]) << v;
  }
}

TEST(LayeredBody, NarrowBoneLiesAsDeepAsItDid) {
  const auto wide = trunk([](Scene& s) { s.tissue.narrow_bone = false; });
  const auto narrow = trunk();
  EXPECT_EQ(narrow->healthy->tissue.thickness_mm, wide->healthy->tissue.thickness_mm);
  const std::string refused = support::thrownMessage([] {
    trunk([](Scene& s) {
      s.lumps.resize(1);
      s.lumps[0].x_mm = 2.0;  // T6
      s.lumps[0].y_mm = 38.0;
      s.lumps[0].depth_mm = 3.0;
      s.lumps[0].diameter_mm = 6.5;
    });
  });
  EXPECT_NE(refused.find("reaches the bone: its bottom is at 9.5 mm, the bone at 10."), std::string::npos) << refused;
}

TEST(LayeredBody, SaysWhichFingerIsLargerThanWhatWasSolved) {
  const auto notes = [](double radius_mm, bool counts) {
    const auto world = trunk([&](Scene& s) {
      s.fingers.resize(1);
      s.fingers[0].name = "palm";
      s.fingers[0].radius_mm = radius_mm;
      s.tissue.by_finger_radius = counts;
    });
    return std::ranges::count_if(world->notes, [](const std::string& note) {
      return note ==
             "finger 'palm': the layered force for a radius of 30 mm is that for 24 mm, the nearest radius that was "
             "solved";
    });
  };
  EXPECT_EQ(notes(30.0, true), 1);
  EXPECT_EQ(notes(30.0, false), 0);
  EXPECT_EQ(notes(24.0, true), 0);
}

}  // namespace
}  // namespace palpate::scene
