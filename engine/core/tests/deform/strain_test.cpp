#include "palpate/deform/strain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/tests/deform/shapes.h"
#include "support/golden.h"

namespace palpate::deform {

using test::vec3;

TEST(Strain, EdgesOfTheReference) {
  for (const auto& c : test::goldenRows("strain", "cases")) {
    double sum = 0.0;
    for (std::size_t i = 0; i < c["rest_nb"].size(); ++i) {
      const Vec3 rest = vec3(c["rest_nb"][i]) - vec3(c["rest_center"]);
      const Vec3 now = vec3(c["def_nb"][i]) - vec3(c["def_center"]);
      const double strain = edgeStrain(rest, now - rest);
      EXPECT_NEAR(strain, c["edge_strains"][i], 1e-12) << c["name"];
      sum += strain;
    }
    EXPECT_NEAR(sum / static_cast<double>(c["rest_nb"].size()), c["strain"], 1e-12) << c["name"];
  }
}

TEST(Strain, EdgeWithoutLengthHasNone) { EXPECT_EQ(edgeStrain(Vec3::Zero(), Vec3(1, 2, 3)), 0.0); }

/// (4.20) from the positions alone.
double strainFromPositions(const Skin& skin, const DeformedSurface& surface, Index v) {
  double sum = 0.0;
  for (const Index w : skin.neighbours[v]) {
    const double rest = (skin.restPosition(w) - skin.restPosition(v)).cast<double>().norm();
    const double now = (surface.positionAt(w).cast<double>() - surface.positionAt(v).cast<double>()).norm();
    sum += now / rest - 1.0;
  }
  return sum / static_cast<double>(skin.neighbours[v].size());
}

TEST(Strain, DeformedSurfaceCarriesTheMeanOfEachVertex) {
  const auto mesh = lab::backMesh(8163);
  const Skin skin = buildSkin(mesh);
  Settings settings;
  settings.strain = true;
  Deformer deformer(skin, settings);
  DeformedSurface surface(skin);
  Random random(19);
  for (int i = 0; i < 20; ++i) {
    deformer.apply(std::vector<Contact>{test::anyContact(mesh, random), test::anyContact(mesh, random)}, surface);
    for (Index v = 0; v < skin.vertices; ++v) {
      ASSERT_NEAR(surface.strain()[v], strainFromPositions(skin, surface, v), 1e-4) << v;
    }
  }
}

TEST(Strain, PressStretchesAndDragCompressesInFront) {
  const auto mesh = lab::flatMesh();
  const Skin skin = buildSkin(mesh);
  Settings settings;
  settings.strain = true;
  const Contact contact = test::press(mesh, test::triangleNear(mesh, {50, 50, 0}), 0.0);
  Contact dragged = test::drag(contact, {5, 0, 0});
  dragged.tangential_region = maps::liftedOntoSurface({40.0, 1.0}, contact.normal);
  const auto surface = deformed(mesh, {&dragged, 1}, settings);
  float in_front = 0.0f;
  float behind = 0.0f;
  for (Index v = 0; v < skin.vertices; ++v) {
    const Vec3 offset = skin.restPosition(v).cast<double>() - contact.anchor;
    if (std::abs(offset.y()) > 5.0 || std::abs(std::abs(offset.x()) - 12.0) > 4.0) continue;
    (offset.x() > 0 ? in_front : behind) += surface.strain()[v];
  }
  EXPECT_LT(in_front, -0.1f);
  EXPECT_GT(behind, 0.1f);
}

TEST(Strain, IsNotWrittenUnlessAskedFor) {
  const auto mesh = lab::backMesh(2962);
  const Contact contact = test::press(mesh, 1000, 8.0);
  const auto surface = deformed(mesh, {&contact, 1});
  for (const float strain : surface.strain()) ASSERT_EQ(strain, 0.0f);
}

TEST(StrainColour, RedIsTensionBlueIsCompression) {
  const Rgb none = strainColour(0.0f);
  const Rgb tension = strainColour(0.2f);
  const Rgb compression = strainColour(-0.2f);
  EXPECT_GT(tension[0], tension[2] + 100);
  EXPECT_GT(compression[2], compression[0] + 100);
  EXPECT_NEAR(none[0], none[2], 15);
  EXPECT_EQ(strainColour(5.0f), tension) << "full colour beyond the range";
  EXPECT_EQ(strainColour(NAN), none);
  EXPECT_EQ(strainColour(0.1f, 0.0f), none);
}

TEST(StrainColour, EveryVertexGetsOne) {
  const std::vector<float> strain{-0.1f, 0.0f, 0.1f};
  std::vector<Rgb> colours(3);
  colourByStrain(strain, 0.1f, colours);
  EXPECT_EQ(colours[0], strainColour(-0.1f, 0.1f));
  EXPECT_EQ(colours[2], strainColour(0.1f, 0.1f));
}

}  // namespace palpate::deform
