// Content of a scene file as plain settings with defaults: a body, how stiff and how soft-edged it is, who touches it
// and what is written down. Read by scene_file.h, built into a World by world.h.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "palpate/base/fidelity.h"
#include "palpate/base/vec.h"
#include "palpate/body/trunk/breathing.h"
#include "palpate/body/trunk/trunk.h"
#include "palpate/contact/finger_state.h"
#include "palpate/hdb/hdb_candidates.h"
#include "palpate/maps/ellipse_map.h"
#include "palpate/maps/measured_stiffness.h"
#include "palpate/maps/natural_variation.h"
#include "palpate/maps/stiffness_map.h"
#include "palpate/scene/deformation_settings.h"
#include "palpate/scene/safety_settings.h"
#include "palpate/scene/view_settings.h"
#include "palpate/tissue/force_law.h"

namespace palpate::scene {

enum class BodyKind : std::uint8_t { trunk, torso, mesh, back };

/// Length of one unit of a mesh file.
enum class Unit : std::uint8_t { from_file, millimetre, centimetre, decimetre, metre, inch };

/// Millimetres of a unit; 0 for from_file: the mesh reader knows what its formats say.
double millimetresOf(Unit unit);

/// Where a picture for the skin comes from, and where the scene file says so (for messages).
struct TextureSource {
  std::filesystem::path file;  ///< PNG or JPEG, or a glTF or GLB file whose base colour it is; empty: no picture
  std::string scene_file;
  std::size_t line = 0;  ///< 0: not from a scene file
};

struct BodySettings {
  BodyKind kind = BodyKind::trunk;
  // A built-in body.
  std::size_t triangles = 0;  ///< of skin and bones together, back: of the skin; 0: as many as the body has by itself
  std::size_t bone_triangles = 0;  ///< of them for bones; 0: the body's own share
  body::TrunkShape shape;          ///< torso and back have only stature, relief and asymmetry of it
  // A mesh file.
  std::filesystem::path file;
  Unit unit = Unit::from_file;
  double scale = 1.0;
  std::string group;   ///< only this group of an OBJ file; empty = all
  bool repair = true;  ///< false: refuse a mesh that is not fit
  TextureSource texture;
  std::filesystem::path fit;  ///< what gives it bones and names (body/fitting/body_fit.h); empty: none
};

enum class StiffnessSource : std::uint8_t { automatic, depth, points, constant };

struct StiffnessSettings {
  StiffnessSource source = StiffnessSource::automatic;  ///< automatic: depth where there are bones, else constant
  double constant_n_per_mm = 0.5;
  maps::DepthLaw depth;
  maps::MeasuredStiffness points;
  maps::NaturalVariation variation = {};  ///< of every source
};

/// Where the ellipse map is asked for the ellipse of a drag.
enum class EllipsePlace : std::uint8_t {
  anchor,          ///< at the friction anchor itself
  nearest_vertex,  ///< at the nearest corner of its triangle: 5.2, where every vertex stores its ellipse
};

struct EllipseSettings {
  std::filesystem::path key_points;   ///< empty: the dissertation's means on the torso, none on a mesh
  maps::MeasuredDataChoice measured;  ///< which of the dissertation's measurements
  maps::EllipseMapSettings map;
  double basic_radius_mm = 0.0;  ///< 0: 150 mm on the torso, on a mesh at most 15 % of its diagonal
  EllipsePlace place = EllipsePlace::anchor;
};

/// The triangles that a finger collides with.
enum class ContactSource : std::uint8_t {
  surface,  ///< the whole skin, by walking on it
  hdb       ///< the triangles that the haptic detecting box found: the dissertation's haptic process
};

/// Behaviour of the felt surface under a press. Based on: Ji, dissertation 2008, 2.3.
enum class HapticSurface : std::uint8_t {
  rigid,          ///< it stays: F = k d, and the skin that is seen sinks by d
  yields,         ///< the contact point sinks by a = F / k, and the tip as far again: F = k d / 2, a = d / 2 (2.3)
  yields_doubled  ///< the same with k doubled: F = k d again, a = d / 2
};

/// The tables [contact] and [friction].
struct ContactSettings {
  ContactSource source = ContactSource::surface;
  HapticSurface haptic_surface = HapticSurface::rigid;
  contact::FingerSettings finger;  ///< of every finger; radius and tick are filled in by contactSettings (world.h)
};

/// For the contact source "hdb".
struct PartitionSettings {
  hdb::BuildSettings build;    ///< the leaf rule is a matter of fidelity (E7)
  double hdb_fraction = 0.25;  ///< edge of the box over the longest edge of the body
  double hdb_edge_mm = 0.0;    ///< edge of the box; 0: by the fraction
  hdb::HdbQuery query = hdb::HdbQuery::leaves;
  std::optional<hdb::LiteralTraversal> traversal;  ///< nothing: exactly, unless fidelity asks for a printed one
  double refresh_s = 0.0;                          ///< the box stays where it is for this long; 0: a tick
};

/// Where the force of a lump comes from.
enum class LumpForce : std::uint8_t {
  table,   ///< the field of a press without it
  solved,  ///< the same, set right on its axis by a solve of the lump itself
};

struct TissueSettings {
  /// Its table is read, its layers are filled in, when the scene is built.
  tissue::ForceLaw force_law = {.kind = tissue::ForceLaw::Kind::layered};
  std::filesystem::path force_table;  ///< for the law of that kind
  double fat_mm = 0.0;                ///< of layered tissue; 0: by the body's mass
  std::filesystem::path layer_table;  ///< one stack for every place (`palpate tissue solve`); empty: the library's
  bool by_finger_radius = true;       ///< layered law: force by the finger's radius; false: every finger is a fingertip
  double point_radius_mm = tissue::kFingertipMm;  ///< layered law: the radius that a point is felt with
  bool narrow_bone = true;                        ///< layered law: bone that is narrow pushes back less than a wide one
  contact::Relaxation relaxation = {};            ///< of every finger's force: filled in by contactSettings (world.h)
  LumpForce lumps = LumpForce::table;
};

/// The motion in one step of a finger's script.
enum class Move : std::uint8_t { press, hold, drag, circle, lift };

struct Step {
  Move move = Move::hold;
  double seconds = 1.0;
  double depth_mm = 8.0;      ///< press: to this depth below the skin at rest
  double height_mm = 10.0;    ///< lift: to this height above it
  Vec2 by_mm = Vec2::Zero();  ///< drag: by this much
  double radius_mm = 10.0;    ///< circle: round the present place
  double turns = 1.0;         ///< circle: negative = clockwise
};

struct Finger {
  std::string name;
  double radius_mm = 0.0;
  std::filesystem::path trajectory;  ///< a table of positions; otherwise the script below
  Vec2 at_mm = Vec2::Zero();         ///< place the script starts over; of a built world also where `at` is
  double start_height_mm = 10.0;
  std::vector<Step> steps;
  // Where its table stands, for messages; line 0: not from a scene file.
  std::string scene_file = {};
  std::size_t line = 0;

  std::string at = {};  ///< that place in words ("T6 right 30 mm"), before at_mm

  std::size_t pad = 0;   ///< taxels along a side of its pad; 0: none
  double pad_mm = 16.0;  ///< side of the pad

  /// Neither path nor script: it gets a path that suits the body.
  bool hasAutomaticPath() const { return trajectory.empty() && steps.empty(); }
};

/// Which finger of the scene a device holds: the first or the second.
enum class HeldFinger : std::uint8_t { left, right };

/// The table [[lump]]: something under the skin. Placed by lumps_of_body.h.
struct LumpSettings {
  std::string name;     ///< empty: lump1, lump2, ... by its number in the scene
  std::string at = {};  ///< its place in words, before x_mm and y_mm
  double x_mm = 0.0;    ///< the skin over its middle, seen along z
  double y_mm = 0.0;
  double depth_mm = 8.0;  ///< of its top under the skin at rest
  double diameter_mm = 10.0;
  std::optional<Vec3> half_axes_mm = {};  ///< in place of the diameter: across, across, into the body
  double stiffness_ratio = 5.0;           ///< over the layer at its centre
  double young_kpa = 0.0;                 ///< in place of the ratio; 0: none
  double edge = 0.0;
  double mobility_mm_per_n = 0.0;  ///< 0: fixed
  double mobility_limit_mm = 10.0;
  double raise_mm = 0.0;  ///< of the skin over it, at rest
  // Where its table and its depth stand, for messages; line 0: not from a scene file.
  std::string scene_file = {};
  std::size_t line = 0;
  std::size_t depth_line = 0;

  Vec3 halfAxes() const { return half_axes_mm.value_or(Vec3::Constant(0.5 * diameter_mm)); }
};

/// The table [[device]]: where the space of a hand lies in the body. Made a device::Workspace by device/workspace.h.
struct DeviceSettings {
  std::string name;  ///< as for --device: "openhaptics:Left"
  HeldFinger finger = HeldFinger::left;
  double scale = 1.0;                  ///< mm of the body a mm of the device
  Vec3 turn_deg = Vec3::Zero();        ///< of the device about the body's x, then y, then z
  std::optional<Vec3> origin_mm = {};  ///< of the body, where the device's own origin lies; nothing: where it suits
  std::size_t clutch_button = 0;       ///< counted from 1; 0: none
  std::size_t stop_button = 0;         ///< likewise
};

struct StrainSettings {
  deform::StrainKind kind = deform::StrainKind::edges;
  double range_percent = 20.0;  ///< strain of full red (tension) and full blue (compression)
};

struct OutputSettings {
  std::vector<double> surfaces_at_s;
  bool forces = true;
};

struct Scene {
  std::filesystem::path file;  ///< where it was read, for messages; empty for one made in memory
  std::string title = "untitled";
  Fidelity fidelity;     ///< which errata are taken as printed (errata.h); none by default
  double seconds = 0.0;  ///< 0 = until the last finger has finished
  double ticks_per_s = 1000.0;
  BodySettings body;
  body::Breathing breathing;  ///< of a body whose landmarks are known
  StiffnessSettings stiffness;
  std::vector<maps::Dysfunction> dysfunctions;
  std::vector<LumpSettings> lumps;
  EllipseSettings ellipses;
  ContactSettings contact;
  PartitionSettings partition;
  TissueSettings tissue;
  DeformationSettings deformation;
  std::vector<PlaceProfile> profiles;
  StrainSettings strain;
  OutputSettings output;
  ViewSettings view;
  SafetySettings safety;
  std::vector<Finger> fingers;
  std::vector<DeviceSettings> devices;
};

}  // namespace palpate::scene
