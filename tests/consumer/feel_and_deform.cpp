// What another simulator does with palpate::palpate: a finger presses the built-in back, the skin follows.
#include <palpate/body/back.h>
#include <palpate/contact/finger.h>
#include <palpate/deform/deformer.h>
#include <palpate/deform/finger_contact.h>

#include <cstdio>

using namespace palpate;

int main() {
  const mesh::TriangleMesh back = body::makeBack({.triangles = 8163, .shape = {}});
  const contact::Surface surface = contact::buildSurface(back, std::vector<double>(back.positions.size(), 0.5));
  contact::FingerState state;
  contact::FingerOutput felt;
  for (int tick = 0; tick < 1000; ++tick)
    felt = contact::step(surface, {}, state, Vec3(60.0, 0.0, 130.0 - 0.025 * tick));

  const deform::Skin skin = deform::buildSkin(back);
  deform::DeformedSurface deformed(skin);
  deform::Deformer deformer(skin, deform::Settings{});
  const auto contact = deform::contactOf(felt, maps::EllipseMap(maps::dissertationKeyPoints()), {});
  if (!contact) return 1;
  const deform::Report report = deformer.apply({&*contact, 1}, deformed);
  std::printf("felt %.2f N at %.2f mm, %u vertices moved\n", felt.force.norm(), felt.depth_mm, report.moved_vertices);
  return felt.force.norm() > 0.5 && report.moved_vertices > 100 ? 0 : 1;
}
