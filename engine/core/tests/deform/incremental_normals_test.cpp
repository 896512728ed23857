#include "palpate/deform/normals.h"

#include <gtest/gtest.h>

#include "core/tests/deform/stage.h"

namespace palpate::deform {

using test::anyContact;
using test::bits;
using test::FormStage;

FormSettings withNormals(Normals normals) {
  FormSettings forms;
  forms.common.normals = normals;
  return forms;
}

float worstDifference(const DeformedSurface& a, const DeformedSurface& b) {
  float worst = 0.0f;
  for (Index v = 0; v < a.vertices(); ++v) worst = std::max(worst, (a.normalAt(v) - b.normalAt(v)).norm());
  return worst;
}

TEST(IncrementalNormals, AreTheRecomputedOnes) {
  for (const auto& mesh : {lab::backMesh(6261), test::torso()}) {
    FormStage incremental(mesh, withNormals(Normals::incremental));
    FormStage recomputed(mesh, withNormals(Normals::recomputed));
    Random random(3);
    for (int i = 0; i < 60; ++i) {
      const std::vector<Contact> contacts{anyContact(mesh, random), anyContact(mesh, random)};
      incremental.apply(contacts);
      recomputed.apply(contacts);
      ASSERT_LT(worstDifference(incremental.surface, recomputed.surface), 1e-6f);
    }
  }
}

// Ten thousand frames of subtracting and adding, and the last one is as good as the first.
TEST(IncrementalNormals, NeverDrift) {
  const auto mesh = test::torso(3);
  FormStage used(mesh, withNormals(Normals::incremental));
  const auto rest = bits(used.surface);
  Random random(11);
  std::vector<Contact> contacts;
  for (int i = 0; i < 10000; ++i) {
    contacts.assign({anyContact(mesh, random)});
    used.apply(contacts);
  }
  FormStage fresh(mesh, withNormals(Normals::incremental));
  fresh.apply(contacts);
  EXPECT_EQ(bits(used.surface), bits(fresh.surface));
  used.apply({});
  EXPECT_EQ(bits(used.surface), rest);
}

TEST(IncrementalNormals, ComputeOnlyWhatChanged) {
  const auto mesh = lab::backMesh(41582);
  FormStage stage(mesh, withNormals(Normals::incremental));
  const Contact contact = test::press(mesh, test::triangleNear(mesh, {175, 200, 100}), 6.0);
  const Index triangles_in_region = stage.apply({contact}).changed_triangles;
  EXPECT_GT(triangles_in_region, 100u);
  EXPECT_LT(triangles_in_region, 5000u);
  EXPECT_EQ(stage.apply({contact}).changed_triangles, 0u) << "the same frame again";
  EXPECT_EQ(stage.apply({}).changed_triangles, triangles_in_region) << "all the way back";
}

TEST(IncrementalNormals, KeepTheirDigitsBesideHugeTriangles) {
  auto mesh = zoo::grid(30, 30.0);
  mesh.positions.insert(mesh.positions.end(), {{1e4, 0, 0}, {1e4, 1e4, 0}, {0, 1e4, 0}});
  const auto n = static_cast<Index>(mesh.positions.size());
  mesh.triangles.push_back({n - 3, n - 2, n - 1});
  FormStage incremental(mesh, withNormals(Normals::incremental));
  FormStage recomputed(mesh, withNormals(Normals::recomputed));
  const Contact contact = test::press(mesh, 900, 4.0);
  incremental.apply({contact});
  recomputed.apply({contact});
  EXPECT_LT(worstDifference(incremental.surface, recomputed.surface), 2e-6f);
}

// Settings say it all: nobody has to know which way keeps a list of triangles.
TEST(IncrementalNormals, ComeForTheAsking) {
  const auto mesh = lab::backMesh(2962);
  const Skin skin = buildSkin(mesh);
  const Contact contact = test::press(mesh, 1000, 6.0);
  Settings settings;
  settings.normals = Normals::incremental;
  Deformer deformer(skin, settings);
  DeformedSurface surface(skin);
  EXPECT_GT(deformer.apply({&contact, 1}, surface).changed_triangles, 10u);
  settings.normals = Normals::recomputed;
  EXPECT_LT(worstDifference(surface, deformed(mesh, {&contact, 1}, settings)), 1e-4f);
}

}  // namespace palpate::deform
