// Words, numbers and scales around the picture: what it shows, how large it is, which way is up, how hard is pressed.
//
// Drawn on a page (drawing.h) that lies in the plane of the screen, so both eyes see it at the same place.
#pragma once

#include <string>
#include <vector>

#include "palpate/view/drawing.h"
#include "palpate/view/renderer.h"
#include "palpate/view/stereo.h"

namespace palpate::view {

struct LabelSettings {
  std::string title;                      ///< upper left; empty = none
  bool legend = true;                     ///< of the colours of the skin, when they mean something
  bool scale_bar = true;                  ///< true in the plane of the screen
  bool orientation = true;                ///< the patient's left and right, and where the head is
  bool numbers = true;                    ///< depth and force beside each finger that touches
  bool section = true;                    ///< the cut through the contact, when the look shows it
  std::vector<std::string> finger_names;  ///< in the order of the fingers; empty = without names
};

/// What the labels speak of.
struct LabelScene {
  const scene::World& world;
  const deform::DeformedSurface& surface;
  const Frame& frame;
  const Look& look;
  const Camera& camera;
  const Eyes& eyes;
};

/// Draws all labels that the settings ask for, on a page that has begun.
void drawLabels(Drawing& page, const LabelScene& scene, const LabelSettings& settings);

}  // namespace palpate::view
