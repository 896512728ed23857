// What a page calls that shows a body felt elsewhere: ServedSkin in plain C names. The functions are those of
// web/page/served_skin.js.
#include <array>
#include <memory>

#include "engine/exports.h"
#include "engine/served_skin.h"

namespace palpate::web {

namespace {

std::unique_ptr<ServedSkin> served;

}  // namespace

PALPATE_EXPORT const char* palpate_served_open(const char* skin, std::size_t skin_length, const char* forms,
                                               std::size_t forms_length) {
  return errorOf([&] {
    served.reset();  // there may not be room for both
    served = std::make_unique<ServedSkin>(std::string_view(skin, skin_length), std::string_view(forms, forms_length));
  });
}

PALPATE_EXPORT std::size_t palpate_served_vertices() { return served->skin().vertices; }
PALPATE_EXPORT std::size_t palpate_served_triangles() { return served->skin().triangles.size(); }
PALPATE_EXPORT const Index* palpate_served_corners() { return served->skin().triangles.data()->data(); }

/// An error for bytes that are no frame: a server of another version.
PALPATE_EXPORT const char* palpate_served_follow(const char* frame, std::size_t length) {
  return errorOf([&] {
    if (!served->follow({frame, length})) throw std::runtime_error("the server sent a frame that is none");
  });
}
PALPATE_EXPORT double palpate_served_tick() { return static_cast<double>(served->newest().tick); }
PALPATE_EXPORT std::size_t palpate_served_fingers() { return served->newest().fingers.size(); }

/// Tip, proxy, normal, force (three each), depth, touch (0 free, 1 stick, 2 slip).
PALPATE_EXPORT const double* palpate_served_felt(std::size_t finger) {
  static std::array<double, 14> numbers;
  const engine::StreamedFinger& felt = served->newest().fingers[finger];
  double* out = numbers.data();
  for (const Vec3* v : {&felt.tip, &felt.proxy, &felt.normal, &felt.force}) out = std::copy(v->begin(), v->end(), out);
  *out++ = felt.depth_mm;
  *out = static_cast<double>(felt.touch);
  return numbers.data();
}

/// Packs what changed since the last call (or all); gives the number of ranges.
PALPATE_EXPORT std::size_t palpate_served_pack(int all) {
  served->pack(all != 0);
  return served->ranges().size() / 2;
}
PALPATE_EXPORT const std::uint32_t* palpate_served_ranges() { return served->ranges().data(); }
PALPATE_EXPORT const float* palpate_served_values() { return served->values().data(); }
PALPATE_EXPORT std::size_t palpate_served_floats() { return served->values().size(); }

}  // namespace palpate::web
