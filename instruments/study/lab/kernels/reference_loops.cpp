// Do not improve this file: every baseline that was ever written is measured against it.
#include "lab/kernels/kernel_times.h"

#include <cmath>
#include <numeric>

#include "palpate/base/random.h"

namespace palpate::bench {

ReferenceLoops::ReferenceLoops() : triangles_(kSteps), floats_(kFloats, 1.0f) {
  Random random(1);
  for (Triangle& triangle : triangles_) {
    for (double& corner : triangle.corners) corner = random.uniform(0.5, 1.5);
  }
  // One cycle through all triangles in random order (Sattolo's algorithm).
  std::vector<long> order(kSteps);
  std::iota(order.begin(), order.end(), 0L);
  for (std::size_t i = kSteps - 1; i > 0; --i) std::swap(order[i], order[random.below(i)]);
  for (std::size_t i = 0; i < kSteps; ++i) triangles_[i].next = order[i];
}

double ReferenceLoops::arithmetic() {
  double sum = 0.0;
  for (int step = 0; step < kSteps; ++step) {
    const Triangle& t = triangles_[static_cast<std::size_t>(place_)];
    const double* c = t.corners;
    const double x = c[1] * c[5] - c[2] * c[4], y = c[2] * c[3] - c[0] * c[5], z = c[0] * c[4] - c[1] * c[3];
    const double u = y * c[6] - z * c[1], v = z * c[0] - x * c[6], w = x * c[1] - y * c[0];
    sum += std::sqrt(u * u + v * v + w * w) / (x * x + y * y + z * z + 1.0);
    place_ = t.next;
  }
  return sum;
}

double ReferenceLoops::memory() {
  for (float& number : floats_) number += 1.0f;
  return floats_[0];
}

}  // namespace palpate::bench
