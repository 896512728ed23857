// Press a finger into the built-in back and drag it: the smallest complete use of the engine from another program.
//
// A device loop does the same once a millisecond: hand the tip's place to contact::step, hand its force to the motors.
#include <cstdio>

#include "palpate/body/back.h"
#include "palpate/contact/finger.h"

using namespace palpate;

int main() {
  const mesh::TriangleMesh back = body::makeBack({.triangles = 8163, .shape = {}});
  const contact::Surface surface =
      contact::buildSurface(back, std::vector<double>(back.positions.size(), 0.5));  // N/mm everywhere

  const contact::FingerSettings fingertip;  // a point with friction 0.46 / 0.44
  contact::FingerState state;               // one per finger
  contact::FingerOutput felt;
  constexpr double kStartHeightMm = 130.0;  // a little above the skin there
  for (int tick = 0; tick < 2000; ++tick) {
    const double t = tick * 0.001;
    const double pressed_mm = t < 1.0 ? 28.0 * t : 28.0;         // down for a second ...
    const double dragged_mm = t < 1.0 ? 0.0 : 20.0 * (t - 1.0);  // ... then to the head
    const Vec3 tip(60.0, dragged_mm, kStartHeightMm - pressed_mm);
    felt = contact::step(surface, fingertip, state, tip);
    if (tick % 400 == 399) {
      std::printf("%.1f s  depth %5.2f mm  force %6.2f %6.2f %6.2f N\n", t, felt.depth_mm, felt.force.x(),
                  felt.force.y(), felt.force.z());
    }
  }
  return felt.touch == contact::Touch::free ? 1 : 0;
}
