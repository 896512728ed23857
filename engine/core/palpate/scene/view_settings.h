// How pictures of a scene look unless the user says otherwise: where from, in which light, which colours, one eye or
// two. The rooms that draw use these enumerations as their own; palpate/view/scene_view.h makes a picture's settings of
// them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "palpate/base/colour_map.h"
#include "palpate/base/vec.h"
#include "palpate/base/words.h"

namespace palpate::scene {

/// `table`: from beside a lying body, on its left, its back up and its head to the left.
enum class StandardView : std::uint8_t { back, left, right, above, front, table, below };

enum class Shading : std::uint8_t {
  gouraud,  ///< light at the vertices, as in the dissertation
  skin,     ///< light at the pixels, with what makes skin look like skin
};

/// The quantity that the skin's colour shows; one at a time.
enum class Colouring : std::uint8_t { plain, strain, stiffness, ellipses, scalar };

/// Things drawn over the skin; any number at once.
enum class Overlay : std::uint8_t {
  wireframe,
  haptic_triangles,  ///< of the leaves that meet the detecting box, green
  leaf_boxes,        ///< blue
  planes,            ///< splitting planes: x green, y red, z yellow (Fig 3.6)
  detecting_box,
  ellipses,  ///< of the contact, and of the key points
  rings,     ///< of neighbours round the anchor's triangle
  arrows,    ///< displacement
  contact,   ///< friction anchor, proxy, tip, force
  normals,
  section,   ///< cut through the contact, rest against deformed, as a curve in mm (Fig 4.7)
  names,     ///< of the body's landmarks, as examiners say them (docs/reference/names.md)
  pressure,  ///< under the fingertips, taxel by taxel, in kPa
  lumps,     ///< at their places under the skin, which becomes translucent
  cut,       ///< cut-away through a finger and the lump nearest to it: layers, bone, lump, pressed skin
  muscles,   ///< the superficial ones of the back, as a drawing on the skin
};

/// `automatic`: the window draws hands where pictures then still come fast enough; everything else draws fingers.
enum class FingerShape : std::uint8_t {
  automatic,
  finger,  ///< a fingertip to the middle of its second joint, with a sleeve in the hand's colour
  hand,
  ball,
  none,
};

/// Side by side and top-bottom put the left eye left and on top, cross the other way round, for eyes that squint.
/// "half" squeezes each eye's picture, as televisions want it; "full" does not.
enum class StereoMode : std::uint8_t {
  mono,
  sbs_half,
  sbs_full,
  sbs_cross,
  tb_half,
  tb_full,
  anaglyph_grey,    ///< red-cyan, no colours: the least rivalry between the eyes
  anaglyph_dubois,  ///< red-cyan, colours as near as glasses let them be
  anaglyph_half,    ///< red-cyan, left eye grey, right eye keeps green and blue
  interlaced,       ///< left eye on even rows of the monitor, for line-polarised screens
  quad_buffer,      ///< the graphics card keeps one picture an eye, for shutter glasses
};

struct ViewSettings {
  StandardView side = StandardView::back;
  double yaw_deg = 0.0;    ///< turned from that side; positive sees more of the patient's right
  double pitch_deg = 0.0;  ///< positive looks from above
  double zoom = 1.0;       ///< 1 shows the whole body
  std::optional<Vec3> look_at_mm;
  double distance_mm = 0.0;  ///< of the eye from there; 0: so far that the whole body is seen

  Shading shading = Shading::skin;
  Colouring colours = Colouring::plain;
  std::vector<Overlay> show;
  double opacity = 1.0;        ///< of the skin
  double skin_tone = 3.0;      ///< from 1, very light, to 6, very dark
  double dent_contrast = 1.0;  ///< 0: dents are not shaded; 1: as they would be near by; above: exaggerated
  FingerShape finger = FingerShape::automatic;
  bool lens = false;  ///< a close view from beside the finger in a corner
  bool white_background = false;
  bool texture = true;  ///< the body's own picture or colours, where its file has some
  // The colouring `scalar`: a number that the body's file brings for each vertex.
  std::string scalar;  ///< its name; empty: the first
  ColourMap scalar_map = ColourMap::viridis;
  std::optional<Vec2> scalar_range;              ///< values of the ends; left out: its least and greatest
  std::optional<Vec2> stiffness_range_n_per_mm;  ///< of the colouring `stiffness`; left out: the body's
  std::optional<Vec2> ellipse_range_mm;          ///< of `ellipse-map`: half major axes; left out: the body's
  bool detail = true;                            ///< pores

  StereoMode stereo = StereoMode::mono;
  double eye_distance_mm = 63.0;
  double convergence_mm = 0.0;
  bool swap_eyes = false;
  std::optional<Vec3> head_mm;  ///< between the eyes, in the frame of the screen
  double screen_height_mm = 300.0;
};

}  // namespace palpate::scene

namespace palpate {

constexpr auto wordTable(Named<scene::StandardView>) {
  return wordsUpTo(scene::StandardView::below, {"back", "left", "right", "above", "front", "table", "below"});
}

constexpr auto wordTable(Named<scene::Shading>) { return wordsUpTo(scene::Shading::skin, {"gouraud", "skin"}); }

constexpr auto wordTable(Named<scene::Colouring>) {
  return wordsUpTo(scene::Colouring::scalar, {"plain", "strain", "stiffness", "ellipses", "scalar"});
}

constexpr auto wordTable(Named<ColourMap>) {
  return wordsUpTo(ColourMap::cyclic, {"viridis", "cividis", "cool-warm", "cyclic"});
}

constexpr auto wordTable(Named<scene::Overlay>) {
  return wordsUpTo(scene::Overlay::muscles,
                   {"wireframe", "triangles", "leaves", "planes", "box", "ellipses", "rings", "arrows", "contact",
                    "normals", "section", "names", "pressure", "lumps", "cut", "muscles"});
}

template <>
struct WordsOf<scene::FingerShape> {
  using V = scene::FingerShape;
  static constexpr std::array kAll = {Word{"auto", V::automatic}, Word{"finger", V::finger}, Word{"hand", V::hand},
                                      Word{"ball", V::ball}, Word{"none", V::none}};
  static constexpr std::array kFormer = {Word{"sphere", V::ball}};
};

constexpr auto wordTable(Named<scene::StereoMode>) {
  return wordsUpTo(scene::StereoMode::quad_buffer,
                   {"mono", "sbs-half", "sbs-full", "sbs-cross", "tb-half", "tb-full", "anaglyph-grey",
                    "anaglyph-dubois", "anaglyph-half", "interlaced", "quad-buffer"});
}

}  // namespace palpate
