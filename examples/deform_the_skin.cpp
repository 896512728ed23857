// Two fingers on the built-in back: from what contact says to a deformed skin with strain, written as PLY.
#include <cstdio>
#include <vector>

#include "palpate/body/back.h"
#include "palpate/contact/finger.h"
#include "palpate/deform/deformer.h"
#include "palpate/deform/finger_contact.h"
#include "palpate/mesh/files/save.h"

using namespace palpate;

namespace {

// A finger that comes down from above (x, y) until it is `depth_mm` under the skin, then goes sideways.
contact::FingerOutput pressAndPull(const contact::Surface& surface, double x, double y, const Vec3& pull) {
  contact::FingerState state;
  contact::FingerOutput felt = contact::step(surface, {}, state, Vec3(x, y, 300.0));
  Vec3 tip(x, y, 300.0);
  while (felt.depth_mm < 9.0 && tip.z() > -300.0) {
    tip.z() -= 0.5;
    felt = contact::step(surface, {}, state, tip);
  }
  for (int tick = 0; tick < 100; ++tick) felt = contact::step(surface, {}, state, tip + pull * (tick / 99.0));
  return felt;
}

}  // namespace

int main() {
  const mesh::TriangleMesh back = body::makeBack({.triangles = 41582, .shape = {}});
  const contact::Surface surface = contact::buildSurface(back, std::vector<double>(back.positions.size(), 0.5));
  const maps::EllipseMap ellipses(maps::dissertationKeyPoints());
  deform::Settings settings;
  settings.strain = true;

  std::vector<deform::Contact> contacts;
  for (const auto& felt : {pressAndPull(surface, -40, 20, {0, 4, 0}), pressAndPull(surface, 40, -60, {-4, 0, 0})}) {
    if (const auto contact = deform::contactOf(felt, ellipses, settings.tissue)) contacts.push_back(*contact);
  }

  const deform::Skin skin = deform::buildSkin(back);
  deform::DeformedSurface surface_now(skin);
  deform::Deformer deformer(skin, settings);
  const deform::Report report = deformer.apply(contacts, surface_now);

  mesh::TriangleMesh picture = back;
  for (Index v = 0; v < skin.vertices; ++v) picture.positions[v] = surface_now.positionAt(v).cast<double>();
  mesh::save("deformed_back.ply", picture,
             {.scalars = {{"strain", {surface_now.strain().begin(), surface_now.strain().end()}}}, .colours = {}});
  std::printf("%u of %u vertices moved; see deformed_back.ply\n", report.moved_vertices, skin.vertices);
  return report.moved_vertices > 0 ? 0 : 1;
}
