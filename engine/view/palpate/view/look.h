// The user's choices about a picture, as plain data.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/colour_map.h"
#include "palpate/base/vec.h"
#include "palpate/scene/view_settings.h"

namespace palpate::view {

// Choices that a scene file can make have their types and names there.
using scene::Colouring;
using scene::FingerShape;
using scene::Overlay;
using scene::Shading;
inline constexpr auto kShadingNames = enumNames<Shading>();
inline constexpr auto kColouringNames = enumNames<Colouring>();
inline constexpr auto kOverlayNames = enumNames<Overlay>();
inline constexpr auto kFingerShapeNames = enumNames<FingerShape>();
inline constexpr std::size_t kOverlays = kOverlayNames.size();
/// In menus and panels: the body, the effects of a touch, the engine's search, the structures under the skin.
inline constexpr std::array kBodyOverlays = {Overlay::names, Overlay::muscles};
inline constexpr std::array kTouchOverlays = {Overlay::contact, Overlay::section, Overlay::arrows, Overlay::ellipses};
inline constexpr std::array kEngineOverlays = {Overlay::wireframe,        Overlay::normals,    Overlay::rings,
                                               Overlay::haptic_triangles, Overlay::leaf_boxes, Overlay::planes,
                                               Overlay::detecting_box};
inline constexpr std::array kLumpOverlays = {Overlay::pressure, Overlay::lumps, Overlay::cut};
static_assert(kBodyOverlays.size() + kTouchOverlays.size() + kEngineOverlays.size() + kLumpOverlays.size() ==
              kOverlays);

/// Each field has a colour map of its own, so that two pictures cannot be mistaken for each other. Strain: blue is
/// compression, red tension.
constexpr ColourMap fieldColourMap(Colouring colouring) {
  if (colouring == Colouring::stiffness) return ColourMap::viridis;
  if (colouring == Colouring::scalar) return ColourMap::viridis;
  return colouring == Colouring::ellipses ? ColourMap::cividis : ColourMap::cool_warm;
}

/// Ends of a colour map, in the unit of the coloured quantity (strain: per cent).
struct ColourRange {
  double low = 0.0;
  double high = 1.0;
};

struct Look {
  Shading shading = Shading::skin;
  Colouring colouring = Colouring::plain;
  std::bitset<kOverlays> overlays;
  double skin_opacity = 1.0;   ///< below 1 the bones show through; 0 hides the skin
  double skin_tone = 3.0;      ///< 1 very light to 6 very dark (skin_tone.h)
  double dent_contrast = 1.0;  ///< 0: dents are not shaded; 1: natural; above: exaggerated
  FingerShape finger = FingerShape::automatic;
  bool lens = false;    ///< a close view from the finger's side in a corner
  bool detail = true;   ///< pores (Shading::skin)
  bool texture = true;  ///< the user's picture or colours, on a skin that has some (Colouring::plain)
  bool cull = true;     ///< skin outside the picture is not drawn; false is for measuring what that saves
  bool white_background = false;
  bool light_background = false;           ///< light grey, for a window of light panels; white has precedence
  std::optional<double> plain_background;  ///< one grey (0 black, 1 white) in place of all: for cutOut (image.h)
  ColourRange strain_percent = {-20.0, 20.0};
  ColourRange stiffness_n_per_mm = {0.3, 1.2};
  ColourRange half_major_mm = {100.0, 200.0};
  // For Colouring::scalar: a number in the body's file (scene/skin_channels.h).
  std::string scalar = {};
  ColourMap scalar_map = ColourMap::viridis;
  ColourRange scalar_range = {0.0, 1.0};

  bool hasLightGround() const { return white_background || light_background; }
  bool shows(Overlay overlay) const { return overlays[static_cast<std::size_t>(overlay)]; }
  void show(Overlay overlay, bool on = true) { overlays[static_cast<std::size_t>(overlay)] = on; }
  ColourMap colourMap() const { return colouring == Colouring::scalar ? scalar_map : fieldColourMap(colouring); }
  const ColourRange& range() const {
    if (colouring == Colouring::scalar) return scalar_range;
    if (colouring == Colouring::stiffness) return stiffness_n_per_mm;
    return colouring == Colouring::ellipses ? half_major_mm : strain_percent;
  }
};

/// The writing over the picture.
struct LabelSettings {
  std::string title;                      ///< upper left; empty = none
  bool legend = true;                     ///< for the colours of the skin and of overlays, when they have a meaning
  bool scale_bar = true;                  ///< true in the plane of the screen
  bool orientation = true;                ///< the patient's left and right, and where the head is
  bool numbers = true;                    ///< depth and force next to each finger that touches
  bool section = true;                    ///< the cut through the contact, when the look shows it
  bool beneath = true;                    ///< pressure, cut-away and the names of lumps, when the look shows them
  std::vector<std::string> finger_names;  ///< in the order of the fingers; empty: no names

  static LabelSettings none() {
    return {.title = {},
            .legend = false,
            .scale_bar = false,
            .orientation = false,
            .numbers = false,
            .section = false,
            .beneath = false,
            .finger_names = {}};
  }
};

}  // namespace palpate::view
