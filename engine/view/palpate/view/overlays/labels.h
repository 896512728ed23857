// Text, numbers and scales around the picture: its contents, its scale, which way is up, how hard the fingers press.
//
// Drawn on a page (drawing.h) in the plane of the screen, so both eyes see it at the same place; only the dots of names
// are drawn for each eye.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "palpate/view/layers/drawing.h"
#include "palpate/view/overlays/body_names.h"
#include "palpate/view/overlays/cut_away.h"
#include "palpate/view/overlays/plates.h"
#include "palpate/view/overlays/pressure_pad.h"
#include "palpate/view/renderer.h"
#include "palpate/view/stereo.h"

namespace palpate::view {

/// Inputs of the labels.
struct LabelScene {
  const scene::World& world;
  const deform::DeformedSurface& surface;
  const Frame& frame;
  const Look& look;
  const Camera& camera;
  const Eyes& eyes;
  std::span<const BodyName> names = {};   ///< this body's
  std::optional<Vec3> eye = {};           ///< owner of this page; empty: between the eyes
  std::span<const PadReading> pads = {};  ///< where the look shows them
  const CutAway* cut = nullptr;           ///< likewise; may be null
};

/// The lines next to a finger: its name, the present depth and whole force, or the maximum of the press that just
/// ended; and, where the finger is deeper than skin is drawn, the drawn depth.
std::vector<std::string> fingerLabelLines(const scene::World& world, const FingerMark& finger, const std::string& name);

/// Draws all labels of the settings, on a page that has begun.
void drawLabels(Drawing& page, const LabelScene& scene, const LabelSettings& settings);

// Labels of the body's names: a dot on the skin, a plate next to the body, a thin line between them.

/// Draws those of `scene.names` that are visible from between the eyes, keeps out of `taken` and adds the plates to it.
/// Plates are in the plane of the screen, the same for both eyes; dots are on the skin, as seen by `scene.eye`.
void drawNames(Drawing& page, const LabelScene& scene, std::vector<LabelBox>& taken);

}  // namespace palpate::view
