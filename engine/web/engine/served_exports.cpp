// The functions for a page that shows a body felt elsewhere: ServedSkin in plain C names. They are those of
// engine/web/page/served_skin.js.
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/exports.h"
#include "engine/frame_packer.h"
#include "palpate/deform/deformer.h"
#include "palpate/engine/contact_stream.h"

namespace palpate::web {

namespace {

/// The skin of a body that is felt elsewhere (`palpate serve`): its bytes in, and for each frame of contacts the same
/// surface that the far side has.
///
///   skin, forms ─ decode ─► deform::Skin, Deformer          frame ─ decode ─► contacts ─► surface ─► ranges, values
///
/// The breath lifts what was deformed at rest: that is how the far side shows it too.
class ServedSkin {
 public:
  /// Throws Error for invalid bytes, and for inconsistent forms.
  ServedSkin(std::string_view skin_bytes, std::string_view forms_bytes);
  ServedSkin(const ServedSkin&) = delete;
  ServedSkin& operator=(const ServedSkin&) = delete;

  const deform::Skin& skin() const { return skin_; }
  /// Returns false for bytes that are not a frame of this skin: then it is untouched.
  bool follow(std::string_view frame_bytes);
  const engine::StreamedFrame& newest() const { return frame_; }

  /// Packs the changes since the last pack, or all; the breath moves all.
  void pack(bool all);
  const std::vector<std::uint32_t>& ranges() const { return packer_.ranges(); }
  const std::vector<float>& values() const { return values_; }

 private:
  std::vector<float> breath_share_;
  mesh::TriangleMesh mesh_;
  deform::Skin skin_;
  deform::Deformer deformer_;
  deform::DeformedSurface surface_;
  engine::StreamedFrame frame_;
  FramePacker packer_;
  std::vector<float> values_;
  double packed_lift_mm_ = 0.0;

  ServedSkin(engine::StreamedSkin streamed, const deform::FormSettings& forms);
};

ServedSkin::ServedSkin(std::string_view skin_bytes, std::string_view forms_bytes)
    : ServedSkin(engine::decodeSkin(skin_bytes), engine::decodeForms(forms_bytes)) {}

ServedSkin::ServedSkin(engine::StreamedSkin streamed, const deform::FormSettings& forms)
    : breath_share_(std::move(streamed.breath_share)),
      mesh_(std::move(streamed.mesh)),
      skin_(deform::buildSkin(mesh_)),
      deformer_(skin_, forms),
      surface_(skin_) {}

bool ServedSkin::follow(std::string_view frame_bytes) {
  const bool taken = engine::decodeFrame(frame_bytes, static_cast<Index>(skin_.triangles.size()), frame_);
  deformer_.apply(frame_.contacts, surface_);
  return taken;
}

void ServedSkin::pack(bool all) {
  const bool moved = !breath_share_.empty() && frame_.lift_mm != std::exchange(packed_lift_mm_, frame_.lift_mm);
  all || moved ? packer_.packAll(surface_) : packer_.pack(surface_);
  values_ = packer_.values();
  if (breath_share_.empty()) return;
  float* z = values_.data() + 2;
  for (std::size_t i = 0; i + 1 < ranges().size(); i += 2) {
    for (std::uint32_t v = ranges()[i]; v < ranges()[i + 1]; ++v, z += kFloatsOfVertex) {
      *z += static_cast<float>(frame_.lift_mm) * breath_share_[v];
    }
  }
}

std::unique_ptr<ServedSkin> served;

}  // namespace

PALPATE_EXPORT const char* palpate_served_open(const char* skin, std::size_t skin_length, const char* forms,
                                               std::size_t forms_length) {
  return catchError([&] {
    served.reset();  // there may not be room for both
    served = std::make_unique<ServedSkin>(std::string_view(skin, skin_length), std::string_view(forms, forms_length));
  });
}

PALPATE_EXPORT std::size_t palpate_served_vertices() { return served->skin().vertices; }
PALPATE_EXPORT std::size_t palpate_served_triangles() { return served->skin().triangles.size(); }
PALPATE_EXPORT const Index* palpate_served_corners() { return served->skin().triangles.data()->data(); }

/// Fails for bytes that are not a frame: a server of another version.
PALPATE_EXPORT const char* palpate_served_follow(const char* frame, std::size_t length) {
  return catchError([&] {
    if (!served->follow({frame, length})) throw std::runtime_error("the server and this page have different versions; reload the page");
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

/// Packs the changes since the last call (or all); returns the number of ranges.
PALPATE_EXPORT std::size_t palpate_served_pack(int all) {
  served->pack(all != 0);
  return served->ranges().size() / 2;
}
PALPATE_EXPORT const std::uint32_t* palpate_served_ranges() { return served->ranges().data(); }
PALPATE_EXPORT const float* palpate_served_values() { return served->values().data(); }
PALPATE_EXPORT std::size_t palpate_served_floats() { return served->values().size(); }

}  // namespace palpate::web
