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
#include "palpate/deform/skin.h"
#include "palpate/hdb/hdb_candidates.h"
#include "palpate/maps/literal_ellipse_map.h"
#include "palpate/scene/scene.h"
#include "palpate/scene/tissue_choice.h"
#include "palpate/tissue/layered_tissue.h"

namespace palpate::scene {

/// What lies under the skin of a built-in body; empty for a mesh.
struct Anatomy {
  std::vector<body::Bone> bones;
  std::vector<double> depth_mm;     ///< a skin vertex each: to the nearest bone
  std::vector<Index> nearest_bone;  ///< a skin vertex each: index into `bones`
  std::vector<body::SkinLandmark> landmarks;
  std::optional<body::Support> support;  ///< what the body lies or sits on
};

struct SkinTexture;
struct SkinChannels;
class AnatomicalReach;
struct PlaceCurves;

struct World {
  Scene scene;              ///< the settings it was built from
  std::string body_name;    ///< for reports: "torso" or the file's name
  mesh::TriangleMesh skin;  ///< fit for contact, spatially ordered; triangle numbers everywhere are its own
  bool closed = false;      ///< the skin has no border
  std::vector<double> stiffness_n_per_mm;  ///< a skin vertex each
  contact::Surface surface;
  deform::Skin deformable;
  maps::AnyEllipseMap ellipses;
  deform::FormSettings deformation;               ///< complete: files read, fidelity filled in
  std::optional<maps::PolarContourMap> contours;  ///< measured ones, for the shape "contour"
  Anatomy anatomy;
  /// The tissue over the bones (surface.tissue_mm says how thick); null where it is not layered.
  std::shared_ptr<const tissue::LayeredTissue> layered = nullptr;
  /// How the regions of press and drag follow bones and folds (anatomical_reach.h); null where they do not.
  std::shared_ptr<const AnatomicalReach> reach = nullptr;
  /// Places whose skin follows curves of their own (curves/place_curves.h); null where there are none.
  std::shared_ptr<const PlaceCurves> place_curves = nullptr;
  std::optional<body::BreathField> breath = {};            ///< how the skin moves; none: it does not
  std::vector<std::string> notes;                          ///< what the user should know: repairs, a doubtful unit
  std::vector<std::string> body_notes = {};                ///< those of them that are about the body
  std::shared_ptr<const hdb::HdbSurface> hdb;              ///< for the contact source "hdb", otherwise null
  std::shared_ptr<const SkinTexture> texture = nullptr;    ///< a picture on the skin (skin_texture.h), or null
  std::shared_ptr<const SkinChannels> channels = nullptr;  ///< of the body's file (skin_channels.h), or null
  /// What the body itself says, a skin vertex each, before dysfunctions; empty: the scene says (buildOn).
  std::vector<double> given_stiffness_n_per_mm = {};
  std::shared_ptr<const tissue::LayeredTissue> given_layers = nullptr;  ///< of the body itself (BodyParts), or null
  TissueChoice tissue = {};  ///< what acts, and why where it is not what the scene asks for
};

/// Loads or makes the body, mends and orders it, and builds what the run needs. Throws Error: a file that cannot be
/// read, a mesh that cannot be felt or is not fit although repair is off, key points without stiffness where they are
/// needed.
std::shared_ptr<const World> build(const Scene& scene, const Progress& progress = {});

/// The world's body under other settings of the scene: new maps, dysfunctions, force law or deformation, the same
/// triangles in the same order. `scene.body` is not looked at. Throws Error as build does.
std::shared_ptr<const World> rebuilt(const World& world, const Scene& scene, const Progress& progress = {});

/// Settings of one finger's contact in this scene.
contact::FingerSettings contactSettings(const Scene& scene, const Finger& finger);

}  // namespace palpate::scene
