// Skin, deformer and surface of a mesh, as an application holds them; and forms to try it in.
#pragma once

#include "core/tests/deform/shapes.h"
#include "palpate/deform/deformer.h"

namespace palpate::test {

struct Stage {
  explicit Stage(mesh::TriangleMesh m, const FormSettings& forms = {}, Way way = Way::chosen)
      : mesh(std::move(m)), skin(buildSkin(mesh)), deformer(skin, forms, way), surface(skin) {}
  Report apply(const std::vector<Contact>& contacts) { return deformer.apply(contacts, surface); }
  Vec3 moved(Index v) const { return surface.displacementAt(v).cast<double>(); }

  mesh::TriangleMesh mesh;
  Skin skin;
  Deformer deformer;
  DeformedSurface surface;
};

/// Displaced the general way whatever the forms.
struct FormStage : Stage {
  explicit FormStage(mesh::TriangleMesh m, const FormSettings& forms = {}) : Stage(std::move(m), forms, Way::general) {}
};

/// A dent with a bulge around it, as over a rib; and a drag.
inline LayeredShape bonyShape(double radius_mm = 45.0) {
  std::vector<tissue::CurveSample> down;
  std::vector<tissue::CurveSample> outward;
  std::vector<tissue::CurveSample> drag;
  for (int i = 0; i < 120; ++i) {
    const double q = i / 120.0;
    const double r = q * radius_mm;
    const double wide = std::exp(-std::pow(r / 17.0, 2));
    down.push_back({q, 1.2 * std::exp(-std::pow(r / 8.0, 2)) - 0.2 * wide, 1.0});
    outward.push_back({q, 0.1 * r / 6.0 * std::exp(0.5 - r * r / 72.0), 1.0});
    drag.push_back({q, std::pow(1.0 + 36.0 * q * q, -0.8), 1.0});
  }
  LayeredShape shape;
  shape.press = {radius_mm, tissue::fittedShare(down, tissue::kPressBend),
                 tissue::fittedOutward(outward, tissue::kPressBend)};
  shape.drag = tissue::fittedShare(drag, tissue::kDragBend);
  return shape;
}

inline Contact layered(Contact contact, const LayeredShape& shape = bonyShape()) {
  contact.layered = shape;
  contact.normal_region = maps::liftedOntoSurface({shape.press.radius_mm, 1.0}, contact.normal);
  return contact;
}

/// Nothing is held back: what the formulae say, vertex by vertex.
inline FormSettings formulaeAlone() {
  FormSettings forms;
  forms.common.limit_shear = false;
  return forms;
}

inline FormSettings literally(std::initializer_list<Erratum> errata) {
  FormSettings forms;
  for (const Erratum e : errata) forms.fidelity.setLiteral(e);
  return forms;
}

/// One of everything: a contact with an irregular boundary 60 to 90 mm away, too.
inline Contact anyFormedContact(const mesh::TriangleMesh& mesh, Random& random) {
  Contact contact = anyContact(mesh, random);
  std::vector<double> radii;
  for (int i = 0; i < 16; ++i) radii.push_back(random.uniform(30, 50));
  contact.tangential_contour = maps::contourOnSurface(maps::contourOf(radii), contact.normal);
  return contact;
}

/// Every form differs from the default in something.
inline std::vector<FormSettings> manyForms() {
  std::vector<FormSettings> all(13);
  all[1].normal_profile.kind = tissue::ProfileKind::sharp;
  all[1].tangential_profile.kind = tissue::ProfileKind::power;
  all[2].normal_profile.kind = tissue::ProfileKind::two_gaussians;
  all[2].radial.share = 0.1;
  all[3].shape = Shape::circle;
  all[4].shape = Shape::contour;
  all[4].region = NormalRegion::shared;
  all[5].together = Together::summed;
  all[6].fidelity = literalFidelity();
  all[7] = literally({Erratum::E14_location_ratio, Erratum::E15_aspect});
  all[8] = literally({Erratum::E23_region_search});
  all[9].common.normals = Normals::recomputed;
  all[10].common.normals = Normals::incremental;
  all[11].strain_kind = StrainKind::principal;
  all[12].search = Search::octree;
  for (std::size_t i = 6; i < all.size(); ++i) all[i].common.strain = true;
  return all;
}

}  // namespace palpate::test
