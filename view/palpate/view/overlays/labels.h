// Words, numbers and scales around the picture: what it shows, how large it is, which way is up, how hard is pressed.
//
// Drawn on a page (drawing.h) that lies in the plane of the screen, so both eyes see it at the same place; only the
// dots of names are drawn for each eye.
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

/// What the labels speak of.
struct LabelScene {
  const scene::World& world;
  const deform::DeformedSurface& surface;
  const Frame& frame;
  const Look& look;
  const Camera& camera;
  const Eyes& eyes;
  std::span<const BodyName> names = {};   ///< of this body
  std::optional<Vec3> eye = {};           ///< whose page this is; nothing: between the eyes
  std::span<const PadReading> pads = {};  ///< where the look shows them
  const CutAway* cut = nullptr;           ///< likewise; may be null
};

/// What stands beside a finger, line by line: its name, the depth and the whole force of now, or the most of the press
/// that just ended; and, where the finger is deeper than skin is drawn to give way, how deep it is drawn.
std::vector<std::string> fingerWords(const scene::World& world, const FingerMark& finger, const std::string& name);

/// Draws all labels that the settings ask for, on a page that has begun.
void drawLabels(Drawing& page, const LabelScene& scene, const LabelSettings& settings);

// The names of the body as they are drawn: a dot on the skin, a plate beside the body, a thin line between them.

/// Draws those of `scene.names` that are seen from between the eyes, keeps out of what is taken and adds the plates to
/// it. Plates lie in the plane of the screen, the same for both eyes; dots lie on the skin, where `scene.eye` sees it.
void drawNames(Drawing& page, const LabelScene& scene, std::vector<LabelBox>& taken);

}  // namespace palpate::view
