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

/// What a picture needs of the skin's programs.
struct SkinNeeds {
  bool pores = false;
  bool picture = false;  ///< the user's, bound as texture unit 0, in the place of the skin's own colour
};

class SkinPaint {
 public:
  SkinPaint();

  /// Makes the program current that writes depth alone.
  void useDepth(const Viewpoint& viewpoint) const;
  void useGouraud(const Look& look, const Viewpoint& viewpoint, const SkinNeeds& needs);
  /// The field of the look's colouring.
  void useField(const Look& look, const Viewpoint& viewpoint);
  void useSkin(const Look& look, const Viewpoint& viewpoint, const SkinNeeds& needs);
  /// The same for places that something touches.
  void useTouchedSkin(const Look& look, const Viewpoint& viewpoint, const SkinNeeds& needs, const SkinTouch& touch);

 private:
  const Program& gouraudProgram(const SkinNeeds& needs);
  const Program& skinProgram(const SkinNeeds& needs, bool touched);
  void showMap(Colouring colouring);

  Program field_, depth_;
  // By what is needed; compiled when first used.
  std::array<std::optional<Program>, 2> gouraud_;
  std::array<std::optional<Program>, 8> skin_;
  GlTexture colour_map_;
  Colouring shown_map_ = Colouring::plain;
};

}  // namespace palpate::view
