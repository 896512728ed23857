// How a picture looks: everything the user can choose about it, as plain data.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <string_view>

#include "palpate/base/colour_map.h"
#include "palpate/base/vec.h"

namespace palpate::view {

enum class Shading : std::uint8_t {
  gouraud,  ///< light at the vertices, as in the dissertation
  skin,     ///< light at the pixels, with what makes skin look like skin
};

inline constexpr std::array<std::string_view, 2> kShadingNames = {"gouraud", "skin"};

/// What the colour of the skin says; one at a time.
enum class Colouring : std::uint8_t { plain, strain, stiffness, ellipses };
inline constexpr std::array<std::string_view, 4> kColouringNames = {"plain", "strain", "stiffness", "ellipses"};

/// Each field has a colour map of its own, so that two pictures cannot be mistaken for each other. Strain: blue is
/// compression, red tension.
constexpr ColourMap colourMapOf(Colouring colouring) {
  if (colouring == Colouring::stiffness) return ColourMap::viridis;
  return colouring == Colouring::ellipses ? ColourMap::cividis : ColourMap::cool_warm;
}

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
  section,  ///< cut through the contact, rest against deformed, as a curve in mm (Fig 4.7)
};
inline constexpr std::size_t kOverlays = 11;
inline constexpr std::array<std::string_view, kOverlays> kOverlayNames = {"wireframe", "triangles", "leaves", "planes",
                                                                          "box",       "ellipses",  "rings",  "arrows",
                                                                          "contact",   "normals",   "section"};

enum class FingerShape : std::uint8_t { none, sphere, hand };
inline constexpr std::array<std::string_view, 3> kFingerShapeNames = {"none", "sphere", "hand"};

/// Ends of a colour map, in the unit of what is coloured (strain: per cent).
struct ColourRange {
  double low = 0.0;
  double high = 1.0;
};

/// Linear; from light to dark.
struct SkinTone {
  std::string_view name;
  std::array<float, 3> colour;
};
inline constexpr std::array<SkinTone, 4> kSkinTones = {{{"light", {0.56f, 0.32f, 0.22f}},
                                                        {"tan", {0.44f, 0.25f, 0.17f}},
                                                        {"brown", {0.28f, 0.15f, 0.10f}},
                                                        {"dark", {0.15f, 0.08f, 0.055f}}}};

struct Look {
  Shading shading = Shading::skin;
  Colouring colouring = Colouring::plain;
  std::bitset<kOverlays> overlays;
  double skin_opacity = 1.0;                  ///< below 1 the bones show through; 0 hides the skin
  Vec3f skin_colour = {0.56f, 0.32f, 0.22f};  ///< linear; kSkinTones has some
  FingerShape finger = FingerShape::sphere;
  bool detail = true;   ///< pores (Shading::skin)
  bool texture = true;  ///< the user's picture, on a skin that has one (Colouring::plain)
  bool white_background = false;
  ColourRange strain_percent = {-20.0, 20.0};
  ColourRange stiffness_n_per_mm = {0.3, 1.2};
  ColourRange half_major_mm = {100.0, 200.0};

  bool shows(Overlay overlay) const { return overlays[static_cast<std::size_t>(overlay)]; }
  void show(Overlay overlay, bool on = true) { overlays[static_cast<std::size_t>(overlay)] = on; }
  const ColourRange& range() const {
    if (colouring == Colouring::stiffness) return stiffness_n_per_mm;
    return colouring == Colouring::ellipses ? half_major_mm : strain_percent;
  }
};

}  // namespace palpate::view
