// The skin of a body that is felt elsewhere (`palpate serve`): its bytes in, and for each frame of contacts the same
// surface that the far side has.
//
//   skin, forms ─ decode ─► deform::Skin, Deformer          frame ─ decode ─► contacts ─► surface ─► ranges, values
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/frame_packer.h"
#include "palpate/deform/deformer.h"
#include "palpate/engine/contact_stream.h"

namespace palpate::web {

class ServedSkin {
 public:
  /// Throws Error for bytes that are none, and for forms that make no sense.
  ServedSkin(std::string_view skin_bytes, std::string_view forms_bytes);
  ServedSkin(const ServedSkin&) = delete;
  ServedSkin& operator=(const ServedSkin&) = delete;

  const deform::Skin& skin() const { return skin_; }
  /// False for bytes that are no frame of this skin: then nobody touches it.
  bool follow(std::string_view frame_bytes);
  const engine::StreamedFrame& newest() const { return frame_; }

  /// What changed since the last pack, or all; the breath moves all.
  void pack(bool all);
  const std::vector<std::uint32_t>& ranges() const { return packer_.ranges(); }
  const std::vector<float>& values() const { return values_; }

 private:
  std::vector<float> breath_share_;
  deform::Skin skin_;
  deform::Deformer deformer_;
  deform::DeformedSurface surface_;
  engine::StreamedFrame frame_;
  FramePacker packer_;
  std::vector<float> values_;
  double packed_lift_mm_ = 0.0;

  ServedSkin(engine::StreamedSkin streamed, const deform::FormSettings& forms);
};

}  // namespace palpate::web
