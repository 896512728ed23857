#include "palpate/scene/world.h"

#include <gtest/gtest.h>

#include "host/tests/scene/dome_scene.h"
#include "palpate/base/random.h"
#include "palpate/scene/body_parts.h"
#include "palpate/scene/errata.h"
#include "palpate/scene/healthy_tissue.h"
#include "support/error_message.h"
#include "support/mesh_zoo.h"

namespace palpate::scene {
namespace {

class WorldOf : public DomeScene {
 protected:
  std::string messageOfBuild(const Scene& scene) const {
    return support::thrownMessage([&] { build(scene); });
  }
};

TEST_F(WorldOf, ItsForceLawComesWithTheTableOfItsFile) {
  writeDome("dome.obj");
  write("law.csv", "depth_mm,force_n\n4,2\n8,10\n");
  const auto world = build(meshScene("[tissue]\nforce_law = \"table\"\nforce_table = \"law.csv\"\n"));
  EXPECT_DOUBLE_EQ(tissue::normalForce(world->surface.force_law, 1.0, 6.0), 6.0 * 0.8)
      << "10 N at 8 mm, where 1 N/mm is 8 N";
  write("law.csv", "4,2\n3,5\n");
  EXPECT_NE(messageOfBuild(world->scene).find("law.csv:2: depth_mm must increase"), std::string::npos);
}

TEST_F(WorldOf, AMeshIsScaledOrderedAndEquallyStiff) {
  writeDome("dome.obj");
  const auto world = build(meshScene("unit = \"cm\"\nscale = 0.1\n"));
  EXPECT_EQ(world->body->skin.triangles.size(), 800u);
  EXPECT_NEAR(mesh::boundingBox(world->body->skin).sizes().x(), 200.0, 1e-3);
  EXPECT_FALSE(world->body->closed);
  EXPECT_EQ(*world->surface.stiffness_n_per_mm, std::vector<double>(441, 0.5));
  EXPECT_TRUE(world->body->anatomy.bones.empty());
}

TEST_F(WorldOf, TheBlocksOfABodyHoldAllOfItsSkinToTheLastVertex) {
  for (const int cells : {14, 15, 126}) {  // 127^2 vertices are 63 blocks and one vertex
    std::vector<Index> source_vertex;
    const auto body = builtBody(mendedBody(zoo::grid(cells, 100.0), "sheet", {}, source_vertex), {}, {});
    const auto blocks = [](std::size_t count) { return (count + 255) / 256; };
    ASSERT_EQ(body->vertex_blocks.boxes.size(), blocks(body->skin.positions.size())) << cells;
    ASSERT_EQ(body->triangle_blocks.boxes.size(), blocks(body->skin.triangles.size())) << cells;
    for (std::size_t v = 0; v < body->skin.positions.size(); ++v) {
      EXPECT_TRUE(body->vertex_blocks.boxes[v / 256].contains(body->skin.positions[v].head<2>())) << v;
    }
  }
}

TEST_F(WorldOf, ADysfunctionOffTheBodyIsNoted) {
  writeDome("dome.obj");
  const auto notes = [&](const std::string& more) { return build(meshScene("[[dysfunction]]\n" + more))->notes; };
  EXPECT_TRUE(notes("x_mm = 20\n").empty());
  EXPECT_EQ(notes("x_mm = 400\n"), std::vector<std::string>{"dysfunction 1 at (400, 0) mm has no effect: its radius is "
                                                            "15 mm, but the nearest skin vertex is 300 mm away"});
  EXPECT_EQ(notes("x_mm = 1\ny_mm = 1\nradius_mm = 0.5\n").size(), 1u) << "between the vertices";
}

TEST_F(WorldOf, AMapThatIsTooSteepToSlideOverIsNoted) {
  writeDome("dome.obj");
  const auto notes = [&](const std::string& more) {
    return build(meshScene("[[dysfunction]]\nx_mm = 20\nedge_softness = 0\n" + more))->notes;
  };
  EXPECT_TRUE(notes("change_percent = 900\n").empty()) << "4.5 N/mm between two vertices 10 mm apart";
  const std::vector<std::string> steep = notes("change_percent = 3000\n");
  ASSERT_EQ(steep.size(), 1u);
  EXPECT_NE(steep.front().find("spread the change over at least 5 mm"), std::string::npos) << steep.front();
}

TEST_F(WorldOf, EllipsesAreThePrintedOnesWhereTheSceneSaysSo) {
  writeDome("dome.obj");
  write("keys.csv", "A,0,0,100,2,0\n");
  const auto half_major = [&](const std::string& fidelity) {
    Scene scene = meshScene("[ellipses]\nkey_points = \"keys.csv\"\nbasic_radius_mm = 50\neffect_radius_mm = 60\n");
    if (!fidelity.empty()) scene.fidelity = parseFidelity(fidelity);
    return build(scene)->ellipses.at(80.0, 0.0).half_major_mm;
  };
  EXPECT_NEAR(half_major(""), 50.0, 1e-9);     // out of reach
  EXPECT_GT(half_major("E28"), 51.0);          // reaches 120 mm
  EXPECT_NEAR(half_major("E29"), 50.0, 1e-9);  // the base whichever way directions blend
}

TEST_F(WorldOf, MeasuredStiffnessIsInterpolatedAsTheSceneSays) {
  writeDome("dome.obj");
  write("keys.csv", "A,-50,-50,100,1,90,0.2\nB,50,-50,100,1,90,0.4\nC,-50,50,100,1,90,0.6\nD,50,50,100,1,90,0.8\n");
  const auto built = [&](const std::string& more) {
    return build(meshScene("[ellipses]\nkey_points = \"keys.csv\"\n[stiffness]\nsource = \"points\"\n" + more));
  };
  for (const std::string word : {"thin_plate", "polynomial"}) {  // both reproduce a plane
    const auto world = built("interpolation = \"" + word + "\"\npolynomial_degree = 1\n");
    for (std::size_t v = 0; v < world->body->skin.positions.size(); ++v) {
      const Vec3& p = world->body->skin.positions[v];
      EXPECT_NEAR((*world->surface.stiffness_n_per_mm)[v], std::max(0.5 + 0.002 * p.x() + 0.004 * p.y(), 0.05), 1e-9)
          << word;
    }
    ASSERT_EQ(world->notes.size(), 1u) << "the corner falls below a quarter of the least";
    EXPECT_EQ(rebuilt(*world, world->scene)->notes, world->notes) << "said once, however often it is built";
    EXPECT_TRUE(rebuilt(*world, meshScene())->notes.empty()) << "no longer so";
  }
  EXPECT_TRUE(built("")->notes.empty());
  EXPECT_EQ(messageOfBuild(built("")->scene), "no error");
}

TEST_F(WorldOf, AnotherDysfunctionSharesTheBodyAndAllThatIsHealthy) {
  Scene scene;
  scene.body.triangles = 8000;
  const auto world = build(scene);
  EXPECT_EQ(world->surface.stiffness_n_per_mm, world->healthy->stiffness_n_per_mm) << "nothing is wrong with it";
  scene.dysfunctions = {{.x_mm = 30.0, .y_mm = 40.0, .radius_mm = 25.0}};
  const auto changed = rebuilt(*world, scene);
  EXPECT_EQ(changed->body, world->body);
  EXPECT_EQ(changed->deformable, world->deformable);
  EXPECT_EQ(changed->healthy, world->healthy);
  EXPECT_EQ(changed->reach, world->reach);
  EXPECT_NE(*changed->surface.stiffness_n_per_mm, *world->surface.stiffness_n_per_mm);
  scene.tissue.fat_mm = 20.0;
  const auto fatter = rebuilt(*changed, scene);
  EXPECT_EQ(fatter->body, world->body);
  EXPECT_NE(fatter->healthy, world->healthy);
}

/// A skin of a million vertices takes 0.1 GB.
TEST_F(WorldOf, TheFirstWorldDeformsItsBodysOwnSkin) {
  for (const TissueModel model : {TissueModel::layered, TissueModel::gaussian}) {
    Scene scene;
    scene.body.kind = BodyKind::trunk;
    scene.body.triangles = 8000;
    scene.deformation.tissue = model;
    const auto world = build(scene);
    EXPECT_EQ(world->deformable.get(), &world->body->deformable);
    EXPECT_EQ(world->deformable->thickness_mm.empty(), model == TissueModel::layered) << "bones are its limit";
    scene.deformation.tissue = model == TissueModel::layered ? TissueModel::gaussian : TissueModel::layered;
    const auto other = rebuilt(*world, scene);
    EXPECT_EQ(other->body, world->body);
    EXPECT_NE(other->deformable->thickness_mm.empty(), world->deformable->thickness_mm.empty());
    EXPECT_EQ(rebuilt(*other, world->scene)->deformable, world->deformable);
  }
}

// Its triangles are the body's.
TEST_F(WorldOf, ADeformableSkinOfItsOwnKeepsTheBody) {
  Scene scene;
  scene.body.triangles = 8000;
  auto world = build(scene);
  scene.deformation.tissue = TissueModel::gaussian;
  auto other = rebuilt(*world, scene);
  ASSERT_NE(other->deformable, world->deformable);
  const std::weak_ptr<const Body> body = world->body;
  auto deformable = other->deformable;
  world = other = nullptr;
  EXPECT_FALSE(body.expired());
  deformable = nullptr;
  EXPECT_TRUE(body.expired());
}

/// Settings that decide what a rebuilt world may take over, changed at random.
Scene changedScene(const Scene& before, Random& random) {
  Scene scene = before;
  switch (random.below(8)) {
    case 0:
      scene.dysfunctions.push_back({.x_mm = random.uniform(-120.0, 120.0),
                                    .y_mm = random.uniform(-150.0, 150.0),
                                    .radius_mm = random.uniform(0.0, 60.0),
                                    .change_percent = random.uniform(-100.0, 900.0),
                                    .edge_softness = random.uniform(0.0, 1.0)});
      break;
    case 1:
      scene.dysfunctions.clear();
      break;
    case 2:
      scene.tissue.fat_mm = random.uniform(0.0, 20.0);
      break;
    case 3:
      scene.tissue.narrow_bone = !scene.tissue.narrow_bone;
      break;
    case 4:
      scene.stiffness.variation.variation = random.below(2) == 0 ? 0.0 : 0.3;
      break;
    case 5:
      scene.deformation.tissue = random.below(2) == 0 ? TissueModel::layered : TissueModel::gaussian;
      break;
    case 6:
      scene.stiffness.source = random.below(2) == 0 ? StiffnessSource::automatic : StiffnessSource::constant;
      break;
    default:
      scene.deformation.forms.common.tissue.normal_cap_mm = random.uniform(5.0, 30.0);
  }
  return scene;
}

TEST_F(WorldOf, RebuiltItIsAsIfItWereBuilt) {
  for (const BodyKind kind : {BodyKind::torso, BodyKind::trunk}) {
    Scene scene;
    scene.body.kind = kind;
    scene.body.triangles = 8000;
    auto world = build(scene);
    Random random(12);
    for (int step = 0; step < 4; ++step) {
      scene = changedScene(changedScene(scene, random), random);
      world = rebuilt(*world, scene);
      const auto fresh = build(scene);
      EXPECT_EQ(*world->surface.stiffness_n_per_mm, *fresh->surface.stiffness_n_per_mm) << step;
      EXPECT_EQ(world->surface.tissue_mm, fresh->surface.tissue_mm) << step;
      EXPECT_EQ(world->deformable->thickness_mm, fresh->deformable->thickness_mm) << step;
      EXPECT_EQ(world->notes, fresh->notes) << step;
      EXPECT_EQ(world->layered != nullptr, fresh->layered != nullptr) << step;
      EXPECT_EQ(world->reach != nullptr, fresh->reach != nullptr) << step;
    }
  }
}

TEST_F(WorldOf, ADysfunctionChangesTheStiffnessWhereItIs) {
  writeDome("dome.obj");
  const auto world = build(meshScene("[[dysfunction]]\nx_mm = 50\nradius_mm = 20\nchange_percent = -40\n"));
  std::size_t in_the_middle = 0, outside = 0;
  for (std::size_t v = 0; v < world->body->skin.positions.size(); ++v) {
    const Vec3& p = world->body->skin.positions[v];
    const double distance = (p.head<2>() - Vec2(50, 0)).norm();
    if (distance < 1e-6) {
      EXPECT_NEAR((*world->surface.stiffness_n_per_mm)[v], 0.3, 1e-12);
      ++in_the_middle;
    } else if (distance > 20.0) {
      EXPECT_EQ((*world->surface.stiffness_n_per_mm)[v], 0.5);
      ++outside;
    }
  }
  EXPECT_EQ(in_the_middle, 1u);
  EXPECT_GT(outside, 10u);
}

TEST_F(WorldOf, NamesWhatCannotBeBuilt) {
  EXPECT_EQ(messageOfBuild(meshScene()), (folder_ / "dome.obj").string() + ": no such file");
  write("dome.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  EXPECT_EQ(messageOfBuild(meshScene()).find((folder_ / "dome.obj").string() + ": "), 0u);
  writeDome("dome.obj");
  EXPECT_NE(messageOfBuild(meshScene("[stiffness]\nsource = \"depth\"\n")).find("requires bones"), std::string::npos);
  EXPECT_NE(messageOfBuild(meshScene("[stiffness]\nsource = \"points\"\n")).find("requires key points"),
            std::string::npos);
}

TEST_F(WorldOf, RefusesAnUnfitMeshWhenRepairIsOff) {
  // A fin: two triangles back to back.
  write("dome.obj", "v 0 0 0\nv 100 0 0\nv 0 100 0\nv 100 100 0\nf 1 2 3\nf 2 4 3\nf 2 3 4\n");
  EXPECT_NE(messageOfBuild(meshScene("repair = false\n")).find("is not fit for contact and repair is off"),
            std::string::npos);
}

TEST_F(WorldOf, NotesADoubtfulUnit) {
  writeDome("dome.obj");
  const auto world = build(meshScene("scale = 0.01\n[stiffness]\nsource = \"constant\"\n"));
  ASSERT_FALSE(world->notes.empty());
  EXPECT_NE(world->notes.back().find("check unit and scale"), std::string::npos);
}

TEST_F(WorldOf, RebuiltIsWhatBuildingAnewGives) {
  writeDome("dome.obj");
  Scene scene = meshScene("[stiffness]\nsource = \"constant\"\n");
  const auto first = build(scene);
  scene.dysfunctions.push_back({50.0, 50.0, 30.0, 80.0, 0.5});
  const auto again = rebuilt(*first, scene);
  const auto anew = build(scene);
  EXPECT_EQ(*again->surface.stiffness_n_per_mm, *anew->surface.stiffness_n_per_mm);
  EXPECT_NE(*again->surface.stiffness_n_per_mm, *first->surface.stiffness_n_per_mm);
  EXPECT_EQ(again->body->skin.triangles, anew->body->skin.triangles);
  EXPECT_EQ(again->notes, anew->notes);
  EXPECT_EQ(again->surface.geometry->closed, anew->surface.geometry->closed);
}

TEST_F(WorldOf, TheTorsoIsStifferOverBoneAndKnowsItsLandmarks) {
  const auto world = build(parse(
      "[body]\nkind = \"torso\"\ntriangles = 8163\n[[finger]]\nname = \"a\"\nscript = [{ do = \"press\" }]\n", "s"));
  const Anatomy& anatomy = world->body->anatomy;
  ASSERT_EQ(anatomy.depth_mm.size(), world->body->skin.positions.size());
  EXPECT_EQ(anatomy.bones.size(), body::kBoneCount);
  std::size_t shallow = 0;
  std::size_t deep = 0;
  for (std::size_t v = 0; v < anatomy.depth_mm.size(); ++v) {
    if (anatomy.depth_mm[v] < anatomy.depth_mm[shallow]) shallow = v;
    if (anatomy.depth_mm[v] > anatomy.depth_mm[deep]) deep = v;
  }
  EXPECT_GT((*world->surface.stiffness_n_per_mm)[shallow], 1.5 * (*world->surface.stiffness_n_per_mm)[deep]);
}

}  // namespace
}  // namespace palpate::scene
