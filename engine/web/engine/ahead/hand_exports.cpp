// The hand that is drawn where a finger presses, for the page: its mesh, and its grip points.
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "engine/exports.h"
#include "palpate/body/hand.h"

namespace palpate::web {

namespace {

struct HandBytes {
  std::vector<float> positions;
  std::vector<std::uint32_t> corners;
  std::array<double, 9> held{};  // pad, pad_along, forearm
};
HandBytes hand;

HandBytes bytesOf(const body::PalpatingHand& made) {
  HandBytes bytes;
  for (const Vec3& p : made.mesh.positions) {
    for (const double axis : p) bytes.positions.push_back(static_cast<float>(axis));
  }
  for (const Triangle& t : made.mesh.triangles) bytes.corners.insert(bytes.corners.end(), t.begin(), t.end());
  double* out = bytes.held.data();
  for (const Vec3* v : {&made.pad, &made.pad_along, &made.forearm}) out = std::copy(v->begin(), v->end(), out);
  return bytes;
}

}  // namespace

/// The right hand; the left one is its mirror image in x.
PALPATE_EXPORT const char* palpate_make_hand() {
  return catchError([] { hand = bytesOf(body::makePalpatingHand(body::Side::right)); });
}
PALPATE_EXPORT std::size_t palpate_hand_vertices() { return hand.positions.size() / 3; }
PALPATE_EXPORT const float* palpate_hand_positions() { return hand.positions.data(); }
PALPATE_EXPORT std::size_t palpate_hand_corners() { return hand.corners.size(); }
PALPATE_EXPORT const std::uint32_t* palpate_hand_triangles() { return hand.corners.data(); }
PALPATE_EXPORT const double* palpate_hand_held() { return hand.held.data(); }

}  // namespace palpate::web
