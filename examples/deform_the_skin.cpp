// Two fingers on the built-in torso: what they feel, and the skin with its strain, written as PLY.
#include <array>
#include <cstdio>

#include "palpate/engine/simulator.h"
#include "palpate/mesh/files/save.h"

using namespace palpate;

int main() {
  scene::Scene scene;
  scene.fingers.resize(2);
  scene.fingers[1].radius_mm = 8.0;  // the first is a point, the second a fingertip
  engine::Simulator simulator(scene::build(scene));

  // Down from above until a finger is 9 mm deep, then 4 mm sideways, both fingers in every tick.
  std::array<Vec3, 2> tips = {Vec3(-40.0, 20.0, 300.0), Vec3(40.0, -60.0, 300.0)};
  std::array<contact::FingerOutput, 2> felt{};
  for (double down_mm = 0.0; down_mm < 600.0; down_mm += 0.5) {
    for (std::size_t i = 0; i < tips.size(); ++i) {
      if (felt[i].depth_mm < 9.0) tips[i].z() -= 0.5;
    }
    simulator.feel(tips, felt);
  }
  for (int tick = 0; tick < 100; ++tick) {
    tips[0].y() += 0.04;
    tips[1].x() -= 0.04;
    simulator.feel(tips, felt);
  }

  const deform::DeformedSurface& skin = simulator.skin();
  mesh::TriangleMesh picture = simulator.world().body->skin;
  Index moved = 0;
  for (Index v = 0; v < skin.vertices(); ++v) {
    picture.positions[v] = skin.positionAt(v).cast<double>();
    moved += skin.displacementAt(v).isZero(0.0f) ? 0 : 1;
  }
  mesh::save("deformed_torso.ply", picture,
             {.scalars = {{"strain", {skin.strain().begin(), skin.strain().end()}}}, .colours = {}});
  std::printf("%u of %u vertices moved; see deformed_torso.ply\n", moved, skin.vertices());
  return moved > 0 ? 0 : 1;
}
