// The smallest complete simulator: load a scene, give poses, get forces and a deformed surface, all on one thread.
//
//   example_feel_a_back [scene.toml]      without a scene: the built-in torso
//
// A device loop does the same once a millisecond: the tip's place goes to feel(), the force to the motors.
#include <algorithm>
#include <cstdio>

#include "palpate/engine/simulator.h"
#include "palpate/scene/scene_file.h"

using namespace palpate;

int main(int argc, char** argv) {
  const scene::Scene scene = argc > 1 ? scene::load(argv[1]) : scene::Scene();
  engine::Simulator simulator(scene::build(scene));
  const Box3 body = mesh::boundingBox(simulator.world().body->skin);

  contact::FingerOutput felt;
  Vec3 tip(60.0, 0.0, body.max().z() + 5.0);
  for (; felt.depth_mm < 8.0 && tip.z() > body.min().z(); tip.z() -= 0.05) {
    felt = simulator.feel(0, tip);  // down into the skin ...
  }
  for (int tick = 0; tick < 1000; ++tick) {
    tip.y() += 0.02;  // ... and 20 mm towards the head
    felt = simulator.feel(0, tip);
    if (tick % 250 != 249) continue;
    std::printf("depth %5.2f mm  force %6.2f %6.2f %6.2f N\n", felt.depth_mm, felt.force.x(), felt.force.y(),
                felt.force.z());
  }

  const deform::DeformedSurface& skin = simulator.skin();  // once a picture
  double deepest_mm = 0.0;
  for (Index v = 0; v < skin.vertices(); ++v) {
    deepest_mm = std::max<double>(deepest_mm, skin.displacementAt(v).norm());
  }
  std::printf("the skin gives way by up to %.2f mm\n", deepest_mm);
  return deepest_mm > 1.0 ? 0 : 1;
}
