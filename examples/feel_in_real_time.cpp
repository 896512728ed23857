// The same with a servo thread: it feels at 1 kHz, while this thread moves the finger and looks at the skin sixty times
// a second, and half way hands over another world.
//
//   example_feel_in_real_time [scene.toml]
#include <chrono>
#include <cstdio>
#include <thread>

#include "palpate/engine/live_simulator.h"
#include "palpate/scene/scene_file.h"
#include "palpate/tree/triangle_tree.h"

using namespace palpate;

int main(int argc, char** argv) {
  const scene::Scene scene = argc > 1 ? scene::load(argv[1]) : scene::Scene();
  const auto world = scene::build(scene);
  const auto place =
      tree::firstFrontCrossing(world->surface.geometry->tree, Vec3(60, 0, 1000), Vec3(60, 0, -1000)).point;

  engine::LiveSimulator simulator(world);
  constexpr int kFrames = 60;
  for (int frame = 0; frame < kFrames; ++frame) {
    const double depth_mm = -5.0 + 15.0 * frame / kFrames;
    simulator.move(0, place - Vec3(0.0, 0.0, depth_mm));
    if (frame == kFrames / 2) {
      scene::Scene stiffer = world->scene;
      stiffer.stiffness.source = scene::StiffnessSource::constant;
      stiffer.stiffness.constant_n_per_mm = 1.0;
      simulator.change(scene::rebuilt(*world, stiffer));  // engine::WorldBuilder does it beside everything else
    }
    const trace::Sample& felt = simulator.felt()[0];
    const deform::DeformedSurface& skin = simulator.skin();  // what a display would upload
    if (frame % 10 == 9) {
      std::printf("tick %6llu  depth %5.2f mm  force %5.2f N  %zu runs of the skin changed\n",
                  static_cast<unsigned long long>(felt.tick), felt.contact.depth_mm, felt.contact.force.norm(),
                  skin.changed().size());
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(16));
  }
  const double depth_mm = simulator.felt()[0].contact.depth_mm;
  const servo::LoopReport report = simulator.servo().stop();
  std::printf("%llu ticks, half of them computed in %.1f us or less\n", static_cast<unsigned long long>(report.ticks),
              report.compute.p50_us);
  return depth_mm > 1.0 ? 0 : 1;
}
