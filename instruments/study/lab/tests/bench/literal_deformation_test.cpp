#include "lab/literal/deformation.h"

#include <gtest/gtest.h>

#include "core/tests/deform/shapes.h"
#include "palpate/deform/deformer.h"

namespace palpate::bench {

deform::FormSettings literalForms() {
  deform::FormSettings forms;
  for (const Erratum erratum :
       {Erratum::E14_location_ratio, Erratum::E18_profile_rim, Erratum::E21_press_region, Erratum::E23_region_search})
    forms.fidelity.setLiteral(erratum);
  forms.together = deform::Together::summed;
  forms.common.normals = deform::Normals::recomputed;
  return forms;
}

literal::Touch toTouch(const deform::Contact& contact) {
  const maps::SurfaceEllipse& ellipse = contact.tangential_region;
  return {contact.anchor,  static_cast<int>(contact.anchor_triangle),
          contact.normal,  contact.depth_mm,
          contact.drag_mm, ellipse.half_major,
          ellipse.aspect};
}

TEST(LiteralDeformation, MovesTheSkinAsTheEnginesLiteralReadingDoes) {
  const mesh::TriangleMesh back = lab::backMesh(2962);
  const deform::Skin skin = deform::buildSkin(back);
  deform::Deformer engine(skin, literalForms());
  deform::DeformedSurface surface(skin);
  literal::Deformation literally(back);
  Random random(7);
  int moved = 0;
  for (int frame = 0; frame < 20; ++frame) {
    std::vector<deform::Contact> contacts;
    std::vector<literal::Touch> touches;
    for (int finger = 0; finger < 1 + frame % 2; ++finger) {
      contacts.push_back(deform::formedRegions(test::anyContact(back, random), literalForms()));
      touches.push_back(toTouch(contacts.back()));
    }
    engine.apply(contacts, surface);
    literally.apply(touches);
    moved += literally.movedNodes();
    for (Index v = 0; v < skin.vertices; ++v) {
      const literal::Vertex& vertex = literally.mesh().vertices[v];
      ASSERT_LT((vertex.position - surface.positionAt(v).cast<double>()).norm(), 1e-4) << "frame " << frame;
    }
  }
  EXPECT_GT(moved, 1000);
}

TEST(LiteralDeformation, BringsBackEveryPositionAndNormal) {
  const mesh::TriangleMesh back = lab::backMesh(2962);
  const literal::Mesh rest = literal::buildMesh(back);
  literal::Deformation literally(back);
  literally.apply(std::vector{toTouch(test::press(back, 1500, 8.0))});
  const literal::Mesh pressed = literally.mesh();
  literally.apply({});
  EXPECT_EQ(literally.movedNodes(), 0);
  bool has_turned = false;
  for (std::size_t v = 0; v < rest.vertices.size(); ++v) {
    EXPECT_EQ(literally.mesh().vertices[v].position, rest.vertices[v].position);
    EXPECT_EQ(literally.mesh().vertices[v].normal, rest.vertices[v].normal);
    has_turned = has_turned || pressed.vertices[v].normal != rest.vertices[v].normal;
  }
  EXPECT_TRUE(has_turned);
}

}  // namespace palpate::bench
