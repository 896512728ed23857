// The breath lifts what was deformed at rest: that is how the far side shows it too.
#include "engine/served_skin.h"

#include <utility>

namespace palpate::web {

ServedSkin::ServedSkin(std::string_view skin_bytes, std::string_view forms_bytes)
    : ServedSkin(engine::decodeSkin(skin_bytes), engine::decodeForms(forms_bytes)) {}

ServedSkin::ServedSkin(engine::StreamedSkin streamed, const deform::FormSettings& forms)
    : breath_share_(std::move(streamed.breath_share)),
      skin_(deform::buildSkin(streamed.mesh)),
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

}  // namespace palpate::web
