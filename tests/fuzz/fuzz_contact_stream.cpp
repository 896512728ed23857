// Any bytes as a skin, as forms and as a frame of contacts; what is taken deforms a small skin into places that are
// numbers.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "palpate/base/error.h"
#include "palpate/deform/deformer.h"
#include "palpate/engine/contact_stream.h"

namespace {

using namespace palpate;

/// 12 x 12 vertices, 10 mm apart.
mesh::TriangleMesh smallSheet() {
  constexpr Index kSide = 12;
  mesh::TriangleMesh mesh;
  for (Index v = 0; v < kSide * kSide; ++v) mesh.positions.emplace_back(10.0 * (v % kSide), 10.0 * (v / kSide), 0.0);
  for (Index v = 0; v + kSide < kSide * kSide; ++v) {
    if (v % kSide + 1 == kSide) continue;
    mesh.triangles.push_back({v, v + 1, v + 1 + kSide});
    mesh.triangles.push_back({v, v + 1 + kSide, v + kSide});
  }
  return mesh;
}

void deformBy(std::string_view bytes, deform::Deformer& deformer, deform::DeformedSurface& surface, Index triangles) {
  static engine::StreamedFrame frame;
  if (!engine::decodeFrame(bytes, triangles, frame)) {
    if (!frame.contacts.empty() || !frame.fingers.empty()) __builtin_trap();
    return;
  }
  std::string again;
  engine::encodeFrame(frame, again);
  if (again != bytes) __builtin_trap();
  deformer.apply(frame.contacts, surface);
  for (int axis = 0; axis < 3; ++axis) {
    for (const float place : surface.position(axis)) {
      if (!std::isfinite(place)) __builtin_trap();
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  static const mesh::TriangleMesh flat = smallSheet();
  static const deform::Skin sheet = deform::buildSkin(flat);
  const auto triangles = static_cast<Index>(sheet.triangles.size());
  static deform::Deformer fast(sheet);
  static deform::Deformer general(sheet, deform::FormSettings{}, deform::Way::general);
  static deform::DeformedSurface surface(sheet);
  static deform::DeformedSurface other(sheet);
  deformBy(bytes, fast, surface, triangles);
  deformBy(bytes, general, other, triangles);
  try {
    const engine::StreamedSkin skin = engine::decodeSkin(bytes);
    if (skin.mesh.triangles.size() < 10000) deform::buildSkin(skin.mesh);
  } catch (const Error&) {
  }
  try {
    const deform::FormSettings forms = engine::decodeForms(bytes);
    deform::Deformer(sheet, forms).apply({}, surface);
  } catch (const Error&) {
  }
  return 0;
}
