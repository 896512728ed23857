// The fade of the force beyond a border. It is not exactly conservative inside a strip as wide as the depth (press at
// the edge, move in, lift: a little energy is gained); the passivity control of `servo` covers that.
#include "palpate/contact/border.h"

namespace palpate::contact {

double depthAtBorder(const Vec3& place, const Vec3& normal, const Vec3& tip, double radius) noexcept {
  const Vec3 down = place - tip;
  const double below = down.dot(normal);
  const double beyond = (down - below * normal).norm();
  return radius + below - beyond;
}

}  // namespace palpate::contact
