// What another simulator does with palpate::palpate: a body of its own, from a file, a finger that presses and drags
// it, the skin that follows.
#include <palpate/base/error.h>
#include <palpate/body/back.h>
#include <palpate/engine/arrays.h>
#include <palpate/engine/simulator.h>
#include <palpate/mesh/files/load.h>
#include <palpate/mesh/files/save.h>

#include <algorithm>
#include <cstdio>

using namespace palpate;

int main() try {
  mesh::save("back.ply", body::makeBack({.triangles = 8163, .shape = {}}));
  const mesh::TriangleMesh back = mesh::load("back.ply");
  const std::vector<double> stiffness_n_per_mm(back.positions.size(), 0.5);
  engine::Simulator simulator(engine::worldFromMesh(back, stiffness_n_per_mm).world);

  contact::FingerOutput felt;
  Vec3 tip(60.0, 0.0, 130.0);
  for (; felt.depth_mm < 8.0 && tip.z() > 0.0; tip.z() -= 0.025) felt = simulator.feel(0, tip);
  for (int tick = 0; tick < 100; ++tick) {
    tip.y() += 0.03;
    felt = simulator.feel(0, tip);
  }

  const deform::DeformedSurface& skin = simulator.skin();
  Index moved = 0;
  float farthest_mm = 0.0f;
  for (Index v = 0; v < skin.vertices(); ++v) {
    const float by_mm = skin.displacementAt(v).norm();
    moved += by_mm > 0.0f ? 1 : 0;
    farthest_mm = std::max(farthest_mm, by_mm);
  }
  std::printf("felt %.2f N at %.2f mm, %u vertices moved by up to %.2f mm\n", felt.force.norm(), felt.depth_mm, moved,
              farthest_mm);
  return felt.force.norm() > 0.5 && moved > 100 && farthest_mm > 2.0f && !skin.changed().empty() ? 0 : 1;
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
