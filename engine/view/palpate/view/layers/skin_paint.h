// The programs that colour the skin, and their inputs: look, eye, fingers near the skin, marks of presses.
//
// Software GL runs both sides of a condition and every loop at least once, so unneeded parts are compiled out: one
// program per need, made when first used (skin_shader.h has the source).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/view/layers/gl_objects.h"
#include "palpate/view/layers/skin_chunks.h"
#include "palpate/view/layers/skin_dents.h"
#include "palpate/view/layers/viewpoint.h"
#include "palpate/view/look.h"

namespace palpate::view {

/// A mark in coordinates of the skin at rest.
struct PressMark {
  Vec3f place = Vec3f::Zero();
  float radius_mm = 8.0f;
  float strength = 0.0f;  ///< 0 to 1
};

/// A finger that presses now.
struct Press {
  Vec3 anchor = Vec3::Zero();  ///< on the skin at rest
  double radius_mm = 8.0;
  double depth_mm = 0.0;
};

inline constexpr std::size_t kMaxMarks = 8;
/// Skin of a healthy back has its colour again after this time.
inline constexpr double kRefillS = 1.5;

/// Places where the skin is pale because a finger pressed the blood away, and for how long.
///
/// A finger that presses makes a mark where its anchor is and leaves marks behind as it slides; each refills after the
/// finger has gone. No GL: numbers in, numbers out.
///
///   presses of this picture, time ─► Blanching ─► marks, the strongest first ─► SkinPaint, where the skin is drawn
class Blanching {
 public:
  /// The marks at this time, the strongest first, at most kMaxMarks. The same presses and time again change nothing; an
  /// earlier time than the last forgets everything (a replay was wound back).
  std::span<const PressMark> at(double time_s, std::span<const Press> presses);

 private:
  struct Trace {
    PressMark mark;
    double last_pressed_s = 0.0;
  };
  void press(const Press& press, double time_s);

  std::vector<Trace> traces_;
  std::vector<PressMark> marks_;
  double time_s_ = 0.0;
};

/// A rod with round ends that throws a shadow on the skin: a ball where both ends coincide, a finger, a hand.
struct ShadowCaster {
  Vec3f from = Vec3f::Zero();
  Vec3f to = Vec3f::Zero();
  float radius_mm = 8.0f;
};

/// Everything that changes the skin's colour.
struct SkinTouch {
  std::span<const ShadowCaster> casters;
  std::span<const PressMark> marks;
  std::span<const SkinDent> dents;
};

/// The regions of that change: near a finger, in its shadow, where it pressed.
std::vector<Influence> collectInfluences(const SkinTouch& touch, const Lights& lights);

/// Options of the skin's programs for a picture.
struct SkinNeeds {
  bool pores = false;
  bool picture = false;  ///< the user's, bound as texture unit 0, in place of the skin's own colour
  bool colours = false;  ///< the body's file's, in that place
  bool made = false;     ///< that picture has factors on the skin's own colour
};

class SkinPaint {
 public:
  SkinPaint();

  /// Makes the program that writes depth only current.
  void useDepth(const Viewpoint& viewpoint) const;
  /// The field of the look's colouring.
  void useField(const Look& look, const Viewpoint& viewpoint);
  /// Skin in the look's shading.
  void use(const Look& look, const Viewpoint& viewpoint, const SkinNeeds& needs);
  /// The same for touched places.
  void useTouched(const Look& look, const Viewpoint& viewpoint, const SkinNeeds& needs, const SkinTouch& touch);

 private:
  const Program& programFor(Shading shading, const SkinNeeds& needs, bool touched);
  const Program& gouraudProgram(const SkinNeeds& needs, bool touched);
  const Program& skinProgram(const SkinNeeds& needs, bool touched);
  void showMap(ColourMap map);

  Program field_, depth_;
  // One per need; compiled when first used.
  std::array<std::optional<Program>, 8> gouraud_;
  std::array<std::optional<Program>, 16> skin_;
  GlTexture colour_map_;
  std::optional<ColourMap> shown_map_;
};

}  // namespace palpate::view
