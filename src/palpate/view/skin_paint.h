// The programs that colour the skin, and what they want to know.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "palpate/view/blanching.h"
#include "palpate/view/finger_pose.h"
#include "palpate/view/look.h"
#include "palpate/view/skin_chunks.h"
#include "palpate/view/viewpoint.h"

namespace palpate::view {

/// What touches the skin's colour.
struct SkinTouch {
  std::span<const FingerPose> fingers;
  std::span<const PressMark> marks;
};

/// The places whose colour it changes: near a finger, in its shadow, where it pressed.
std::vector<Influence> influencesOf(const SkinTouch& touch, const Lights& lights);

class SkinPaint {
 public:
  SkinPaint();

  /// Makes the program current that writes depth alone.
  void useDepth(const Viewpoint& viewpoint) const;
  void useGouraud(const Look& look, const Viewpoint& viewpoint) const;
  /// The field of the look's colouring.
  void useField(const Look& look, const Viewpoint& viewpoint);
  void useSkin(const Look& look, const Viewpoint& viewpoint, bool pores);
  /// The same for places that something touches.
  void useTouchedSkin(const Look& look, const Viewpoint& viewpoint, bool pores, const SkinTouch& touch);

 private:
  const Program& skinProgram(bool pores, bool touched);
  void showMap(Colouring colouring);

  Program gouraud_, field_, depth_;
  std::array<std::optional<Program>, 4> skin_;  // by what is needed; compiled when first used
  GlTexture colour_map_;
  Colouring shown_map_ = Colouring::plain;
};

}  // namespace palpate::view
