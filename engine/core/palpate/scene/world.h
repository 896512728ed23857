// A scene, built: everything a run reads and nothing it writes. Immutable after build; shared by any number of threads.
//
// Data flow: scene file -> Scene -> build -> World -> servo (surface), display (skin, ellipses), reports (bones,
// notes).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "palpate/base/progress.h"
#include "palpate/contact/finger_state.h"
#include "palpate/deform/forms.h"
#include "palpate/hdb/hdb_candidates.h"
#include "palpate/maps/literal_ellipse_map.h"
#include "palpate/scene/body.h"
#include "palpate/scene/deformation_settings.h"
#include "palpate/scene/scene.h"
#include "palpate/scene/tissue_choice.h"

namespace palpate::contact {
class PressureGround;
}

namespace palpate::scene {

class AnatomicalReach;
struct HealthyTissue;
struct PlaceCurves;
struct PlacedLump;

struct World {
  Scene scene;                       ///< the settings it was built from
  std::shared_ptr<const Body> body;  ///< shared with every world that differs in its settings only; never null
  contact::Surface surface;          ///< the body as it is felt: its stiffness, thickness and force law
  std::shared_ptr<const deform::Skin> deformable;  ///< the body as it is deformed; never null
  maps::AnyEllipseMap ellipses;
  deform::FormSettings deformation;               ///< complete: files read, fidelity filled in
  std::optional<maps::PolarContourMap> contours;  ///< measured ones, for the shape "contour"
  /// The tissue over the bones (surface.tissue_mm says how thick); null where it is not layered.
  std::shared_ptr<const tissue::LayeredTissue> layered = nullptr;
  /// How the regions of press and drag follow bones and folds (anatomical_reach.h); null where they do not.
  std::shared_ptr<const AnatomicalReach> reach = nullptr;
  /// Places whose skin follows curves of their own (place_curves.h); null where there are none.
  std::shared_ptr<const PlaceCurves> place_curves = nullptr;
  std::optional<body::BreathField> breath = {};  ///< how the skin moves; none: it does not
  std::vector<std::string> notes;                ///< what the user should know: repairs, a doubtful unit
  std::shared_ptr<const hdb::HdbSurface> hdb;    ///< for the contact source "hdb", otherwise null
  std::shared_ptr<const HealthyTissue> healthy;  ///< before dysfunctions (healthy_tissue.h); never null
  TissueChoice tissue = {};                      ///< what acts, and why where it is not what the scene asks for
  /// The scene's lumps, as surface.lumps has them and in the same order (lumps_of_body.h).
  std::vector<std::shared_ptr<const PlacedLump>> lumps = {};
  /// Patterns of pressure under a finger; null where the scene has neither lumps nor a pad (pressureGround makes it).
  std::shared_ptr<const contact::PressureGround> pressure = nullptr;
};

/// Loads or makes the body, mends and orders it, and builds what the run needs. Throws Error: a file that cannot be
/// read, a mesh that cannot be felt or is not fit although repair is off, key points without stiffness where they are
/// needed.
std::shared_ptr<const World> build(const Scene& scene, const Progress& progress = {});

/// The world's body under other settings of the scene: new maps, dysfunctions, force law or deformation, the same
/// triangles in the same order. What the settings leave as it is is shared: another dysfunction costs a copy of the
/// stiffness. `scene.body` is not looked at, but for its kind and mass. Where lumps raise the skin otherwise the body
/// is built again. Throws Error as build does.
std::shared_ptr<const World> rebuilt(const World& world, const Scene& scene, const Progress& progress = {});

/// `rebuilt` where lumps raise the skin as before, if at all. It makes no body: a program that calls this alone needs
/// no maker, which a page would carry as 800 kB of its engine. Throws Error for another swelling.
std::shared_ptr<const World> rebuiltOnItsSkin(const World& world, const Scene& scene, const Progress& progress = {});

/// Settings of one finger's contact in this scene.
contact::FingerSettings contactSettings(const Scene& scene, const Finger& finger);

}  // namespace palpate::scene
