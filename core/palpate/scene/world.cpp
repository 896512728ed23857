// Builds a world in the order in which its parts need each other:
//
//   scene ─ forms (their files first) ─► body ─ key points ─► stiffness ─► contact surface ─► detecting box ─► World
//                                          ├─► deformable skin, beside them ──────────────────────────────────────▲
//                                          ├─ bones, contact surface ─► reach of regions ─────────────────────────┤
//                                          └─ key points ─► ellipses, contours ───────────────────────────────────┘
//
// The detecting box is built where it is asked for.
//
// `rebuilt` starts behind the body: nothing it may change moves a vertex.
#include "palpate/scene/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/base/background.h"
#include "palpate/base/error.h"
#include "palpate/body/places.h"
#include "palpate/deform/shear_limit.h"
#include "palpate/scene/anatomical_reach.h"
#include "palpate/scene/body_parts.h"
#include "palpate/scene/curves/place_curves.h"
#include "palpate/scene/hdb_source.h"
#include "palpate/scene/skin_channels.h"
#include "palpate/scene/tissue_of_body.h"
#include "palpate/tissue/force_table.h"
#include "palpate/tree/thickness.h"

namespace palpate::scene {

namespace {

using KeyPoints = std::vector<maps::KeyPoint>;

// ---- ellipses

/// Radius of the basic circle where the scene says none: the dissertation's 150 mm on a back, and on other bodies no
/// more than this share of their diagonal.
constexpr double kBackRadiusMm = 150.0;
constexpr double kRadiusOfDiagonal = 0.15;

/// The user's, or on a built-in body the dissertation's; a mesh has none of its own.
KeyPoints keyPointsOf(const Scene& scene) {
  if (!scene.ellipses.key_points.empty()) return maps::readKeyPoints(scene.ellipses.key_points);
  if (scene.body.kind == BodyKind::mesh) return {};
  maps::MeasuredDataChoice measured = scene.ellipses.measured;
  if (scene.fidelity.literal(Erratum::E30_key_averages)) measured.averaging = maps::Averaging::plain;
  return maps::dissertationKeyPoints(measured);
}

maps::EllipseMapSettings ellipseMapSettings(const Scene& scene, const mesh::TriangleMesh& skin) {
  maps::EllipseMapSettings settings = scene.ellipses.map;
  if (scene.ellipses.basic_radius_mm > 0.0) {
    settings.basic_radius_mm = scene.ellipses.basic_radius_mm;
  } else if (scene.body.kind == BodyKind::mesh) {
    settings.basic_radius_mm = std::min(kBackRadiusMm, kRadiusOfDiagonal * mesh::boundingBox(skin).diagonal().norm());
  }
  return settings;
}

/// The deformation itself reads the ratio as the aspect (E15); doing it here too would undo it.
maps::LiteralForms literalMapForms(const Scene& scene) {
  maps::LiteralForms forms = maps::literalForms(scene.fidelity);
  forms.ratio_as_aspect = false;
  return forms;
}

// ---- stiffness

StiffnessSource resolvedSource(const Scene& scene, const BodyParts& body) {
  if (scene.stiffness.source != StiffnessSource::automatic) return scene.stiffness.source;
  const bool boneless = scene.body.kind == BodyKind::mesh && body.anatomy.depth_mm.empty();
  return boneless ? StiffnessSource::constant : StiffnessSource::depth;
}

std::vector<double> stiffnessFromPoints(const Scene& scene, const std::vector<Vec3>& positions, const KeyPoints& keys,
                                        std::vector<std::string>& notes) {
  const bool any = std::any_of(keys.begin(), keys.end(), [](const auto& key) { return key.stiffness_n_per_mm; });
  if (!any) throw Error("stiffness source \"points\" needs key points with a stiffness ([ellipses] key_points)");
  maps::StiffnessOfPositions stiffness = maps::measuredStiffness(positions, keys, scene.stiffness.points);
  if (stiffness.limited > 0) {
    notes.push_back(fmt::format("stiffness: the fit ran away at {} of {} vertices and was limited there",
                                stiffness.limited, positions.size()));
  }
  return std::move(stiffness.n_per_mm);
}

std::vector<double> healthyStiffness(const Scene& scene, const BodyParts& body, const KeyPoints& keys,
                                     const PlacedTissue& tissue, std::vector<std::string>& notes) {
  if (!body.given_stiffness_n_per_mm.empty()) return body.given_stiffness_n_per_mm;
  switch (resolvedSource(scene, body)) {
    case StiffnessSource::depth:
      if (body.anatomy.depth_mm.empty())
        throw Error("stiffness source \"depth\" needs bones: the built-in bodies have them");
      if (tissue.layered) return secantStiffness(tissue);
      return maps::stiffnessFromDepth(body.anatomy.depth_mm, scene.stiffness.depth);
    case StiffnessSource::points:
      return stiffnessFromPoints(scene, body.skin.positions, keys, notes);
    default:
      return std::vector<double>(body.skin.positions.size(), scene.stiffness.constant_n_per_mm);
  }
}

/// Off the body, or between its vertices: a slip of the pen that nobody would feel.
void noteUnfelt(const std::vector<maps::Dysfunction>& dysfunctions, const std::vector<Vec3>& positions,
                std::vector<std::string>& notes) {
  for (std::size_t i = 0; i < dysfunctions.size(); ++i) {
    const maps::Dysfunction& d = dysfunctions[i];
    const Vec2 centre(d.x_mm, d.y_mm);
    double nearest_mm2 = std::numeric_limits<double>::infinity();
    for (const Vec3& p : positions) nearest_mm2 = std::min(nearest_mm2, (p.head<2>() - centre).squaredNorm());
    const double nearest_mm = std::sqrt(nearest_mm2);
    if (nearest_mm < d.radius_mm) continue;
    notes.push_back(fmt::format(
        "dysfunction {} at ({}, {}) mm changes nothing: it reaches {} mm, the nearest vertex of the skin is "
        "{:.3g} mm away",
        i + 1, d.x_mm, d.y_mm, d.radius_mm, nearest_mm));
  }
}

/// N/mm a mm along the skin; 0 for a triangle without area.
double steepnessOf(const mesh::TriangleMesh& skin, const std::array<Index, 3>& t,
                   const std::vector<double>& stiffness) {
  const Vec3 a = skin.positions[t[1]] - skin.positions[t[0]];
  const Vec3 b = skin.positions[t[2]] - skin.positions[t[0]];
  const double area = a.cross(b).norm();
  const double along_a = stiffness[t[1]] - stiffness[t[0]];
  const double along_b = stiffness[t[2]] - stiffness[t[0]];
  return area > 0.0 ? (along_a * b - along_b * a).norm() / area : 0.0;
}

/// A finger that slides over a steep place gets its force in steps, whatever the loop does
/// (docs/explanation/stability.md).
void noteSteepMap(const mesh::TriangleMesh& skin, const std::vector<double>& stiffness, double tick_s,
                  std::vector<std::string>& notes) {
  constexpr double kDepth = 3.0;
  constexpr double kSpeed = 100.0;   // mm/s
  constexpr double kFeltStep = 0.3;  // N in a tick
  double steepest = 0.0;
  Vec3 place = Vec3::Zero();
  for (const auto& triangle : skin.triangles) {
    const double steepness = steepnessOf(skin, triangle, stiffness);
    if (steepness <= steepest) continue;
    steepest = steepness;
    place = (skin.positions[triangle[0]] + skin.positions[triangle[1]] + skin.positions[triangle[2]]) / 3.0;
  }
  const double step_n = steepest * kDepth * kSpeed * tick_s;
  if (step_n <= kFeltStep) return;
  notes.push_back(fmt::format(
      "the stiffness changes by {:.2g} N/mm within a millimetre at ({:.0f}, {:.0f}, {:.0f}) mm: a finger that slides "
      "there, {} mm deep at {} mm/s, feels steps of {:.2g} N; let it change over 5 mm or more",
      steepest, place.x(), place.y(), place.z(), kDepth, kSpeed, step_n));
}

/// The map plane is seen from behind: what is wrong with the back of the trunk leaves its front as it is.
void keepFront(const mesh::TriangleMesh& skin, const std::vector<double>& healthy, std::vector<double>& stiffness) {
  const std::vector<Vec3> normals = mesh::vertexNormals(skin);
  for (std::size_t v = 0; v < stiffness.size(); ++v) {
    if (normals[v].z() < 0) stiffness[v] = healthy[v];
  }
}

/// A vertex each; what the body has by nature, then what is wrong with it.
std::vector<double> stiffnessOf(const Scene& scene, const BodyParts& body, const KeyPoints& keys,
                                const PlacedTissue& tissue, std::vector<std::string>& notes) {
  std::vector<double> stiffness = healthyStiffness(scene, body, keys, tissue, notes);
  maps::applyVariation(body.skin.positions, scene.stiffness.variation, stiffness);
  if (scene.dysfunctions.empty()) return stiffness;
  const std::vector<double> healthy = stiffness;
  maps::applyDysfunctions(body.skin.positions, scene.dysfunctions, stiffness);
  const bool known_front = body.closed && !body.anatomy.landmarks.empty();
  if (known_front) keepFront(body.skin, healthy, stiffness);
  noteUnfelt(scene.dysfunctions, body.skin.positions, notes);
  return stiffness;
}

// ---- what is felt

tissue::ForceLaw forceLaw(const Scene& scene, const PlacedTissue& tissue) {
  tissue::ForceLaw law = scene.tissue.force_law;
  if (tissue.layered) {
    law.layers = tissue.layered->forceRows();
    law.layers.knows_radius = law.layers.knows_radius && scene.tissue.by_finger_radius;
    law.layers.point_mm = scene.tissue.point_radius_mm;
  }
  if (law.kind == tissue::ForceLaw::Kind::table && !scene.tissue.force_table.empty()) {
    law.table = tissue::readForceTable(scene.tissue.force_table);
  }
  tissue::check(law);
  return law;
}

std::shared_ptr<const hdb::HdbSurface> detectingBoxIfAsked(const Scene& scene, const mesh::TriangleMesh& skin,
                                                           const contact::Surface& surface, const Progress& progress) {
  if (scene.contact.source != ContactSource::hdb) return nullptr;
  return buildHdbSource(scene, skin, surface, progress);
}

/// A finger of a radius that no stack was solved for.
void noteFingers(const Scene& scene, const tissue::ForceLaw& law, std::vector<std::string>& notes) {
  if (law.kind != tissue::ForceLaw::Kind::layered || !law.layers.knows_radius) return;
  const auto& radii = tissue::LayeredForce::kRadiiMm;
  for (const Finger& finger : scene.fingers) {
    if (!(finger.radius_mm > 0.0)) continue;
    const double counts_as = std::clamp(finger.radius_mm, radii.front(), radii.back());
    if (counts_as == finger.radius_mm) continue;
    notes.push_back(
        fmt::format("finger '{}': layers push back on a radius of {:g} mm as on one of {:g} mm, the "
                    "nearest that was solved",
                    finger.name, finger.radius_mm, counts_as));
  }
}

// ---- what is seen

void noteUnknownScalar(const Scene& scene, const SkinChannels* channels, std::vector<std::string>& notes) {
  if (scene.view.scalar.empty() || scalarNamed(channels, scene.view.scalar) != nullptr) return;
  notes.push_back(fmt::format("[view] scalar \"{}\": the body's file brings no such number; it brings {}",
                              scene.view.scalar, scalarNames(channels)));
}

// ---- what a device may do

/// Keys that an earlier limiter obeyed.
void noteOldLimits(const SafetySettings& safety, std::vector<std::string>& notes) {
  const SafetySettings left_out;
  if (safety.slew_per_motion == left_out.slew_per_motion && safety.slew_mm == left_out.slew_mm &&
      safety.passivity_allowance_n_mm == left_out.passivity_allowance_n_mm) {
    return;
  }
  notes.emplace_back(
      "[safety] slew_per_motion, slew_mm and passivity_allowance_n_mm have no effect any more "
      "(docs/explanation/safety.md)");
}

// ---- how it moves

std::optional<body::BreathField> breathOf(const Scene& scene, const BodyParts& body, std::vector<std::string>& notes) {
  if (!scene.breathing.on) return std::nullopt;
  const double front_z = mesh::boundingBox(body.skin).min().z();
  auto breath = body::BreathField::of(scene.breathing, body.anatomy.landmarks, body.anatomy.support, front_z);
  if (!breath) notes.emplace_back("[breathing] changes nothing: only a body whose spine is known breathes");
  return breath;
}

// ---- all together

/// Where the scene names a place, its numbers too.
Scene withPlaces(Scene scene, const std::vector<body::SkinLandmark>& landmarks) {
  const auto find = [&](const std::string& words, double& x_mm, double& y_mm) {
    if (words.empty()) return;
    const Vec3 point = body::placeNamed(landmarks, words).point;
    x_mm = point.x();
    y_mm = point.y();
  };
  for (maps::Dysfunction& dysfunction : scene.dysfunctions) find(dysfunction.at, dysfunction.x_mm, dysfunction.y_mm);
  for (PlaceProfile& profile : scene.profiles) find(profile.at, profile.x_mm, profile.y_mm);
  for (Finger& finger : scene.fingers) {
    try {
      find(finger.at, finger.at_mm.x(), finger.at_mm.y());
    } catch (const Error& error) {
      if (finger.line == 0) throw;
      throw Error::atLine(finger.scene_file, finger.line, error.what());
    }
  }
  return scene;
}

/// A press of all that the cap allows must not come out of the far side of a thin part.
void limitToParts(const mesh::TriangleMesh& skin, const contact::Surface& surface, const deform::FormSettings& forms,
                  deform::Skin& deformable) {
  const double most_mm = forms.common.tissue.normal_cap_mm / deform::ShearLimit::kShareOfThickness;
  setThickness(tree::thicknessUpTo(surface.tree, skin.positions, surface.vertex_normals, most_mm), deformable);
}

std::shared_ptr<const World> withBody(const Scene& asked, BodyParts body, deform::FormSettings forms,
                                      const Progress& progress) {
  const Scene scene = withPlaces(asked, body.anatomy.landmarks);
  const KeyPoints keys = keyPointsOf(scene);
  report(progress, "mapping stiffness", 0.0);
  std::vector<std::string> notes = body.notes;
  noteUnknownScalar(scene, body.channels.get(), notes);
  noteOldLimits(scene.safety, notes);
  PlacedTissue tissue;
  TissueChoice choice = tissueChoice(scene, forms, !body.anatomy.depth_mm.empty());
  if (choice.model == TissueModel::layered) {
    tissue = placedTissue(scene, body.anatomy.depth_mm, body.given_layers);
    if (scene.tissue.narrow_bone) tissue.thickness_mm = overNarrowBone(body.skin, body.anatomy, tissue);
  }
  std::vector<double> stiffness = stiffnessOf(scene, body, keys, tissue, notes);
  if (std::string note = tissueNote(scene, choice, stiffness); !note.empty()) notes.push_back(std::move(note));
  noteSteepMap(body.skin, stiffness, 1.0 / scene.ticks_per_s, notes);
  auto place_curves = placeCurvesOf(scene, forms, notes);
  const std::optional<body::BreathField> breath = breathOf(scene, body, notes);

  report(progress, "building the contact surface", 0.0);
  deform::Skin deformable;  // made beside the surface, which takes four times as long
  Background making_deformable([&] { deformable = deform::buildSkin(body.skin); });
  contact::Surface surface = contact::buildSurface(
      body.skin, stiffness, {forceLaw(scene, tissue), body.self_intersecting, std::move(tissue.thickness_mm)});
  noteFingers(scene, surface.force_law, notes);
  auto hdb = detectingBoxIfAsked(scene, body.skin, surface, progress);

  report(progress, "preparing the deformation", 0.0);
  making_deformable.join();
  // Over bones the tissue's own thickness is the limit.
  if (!tissue.layered && forms.common.limit_shear) limitToParts(body.skin, surface, forms, deformable);
  const maps::EllipseMapSettings map_settings = ellipseMapSettings(scene, body.skin);
  maps::AnyEllipseMap ellipses(keys, map_settings, literalMapForms(scene));
  auto contours = contoursOf(scene, map_settings);
  auto reach = reachOf(scene, body.skin, body.anatomy, surface.tree, tissue.layered.get());

  return std::make_shared<const World>(World{.scene = scene,
                                             .body_name = std::move(body.name),
                                             .skin = std::move(body.skin),
                                             .closed = body.closed,
                                             .stiffness_n_per_mm = std::move(stiffness),
                                             .surface = std::move(surface),
                                             .deformable = std::move(deformable),
                                             .ellipses = std::move(ellipses),
                                             .deformation = std::move(forms),
                                             .contours = std::move(contours),
                                             .anatomy = std::move(body.anatomy),
                                             .layered = std::move(tissue.layered),
                                             .reach = std::move(reach),
                                             .place_curves = std::move(place_curves),
                                             .breath = breath,
                                             .notes = std::move(notes),
                                             .body_notes = std::move(body.notes),
                                             .hdb = std::move(hdb),
                                             .texture = std::move(body.texture),
                                             .channels = std::move(body.channels),
                                             .given_stiffness_n_per_mm = std::move(body.given_stiffness_n_per_mm),
                                             .given_layers = std::move(body.given_layers),
                                             .tissue = std::move(choice)});
}

}  // namespace

std::shared_ptr<const World> build(const Scene& scene, const Progress& progress) {
  checkContactSource(scene);
  deform::FormSettings forms = formsOf(scene);  // first: a fault in its files should not wait for the body
  return withBody(scene, makeBody(scene.body, progress), std::move(forms), progress);
}

std::shared_ptr<const World> buildOn(const Scene& scene, BodyParts body, const Progress& progress) {
  checkContactSource(scene);
  deform::FormSettings forms = formsOf(scene);
  return withBody(scene, std::move(body), std::move(forms), progress);
}

std::shared_ptr<const World> rebuilt(const World& world, const Scene& scene, const Progress& progress) {
  BodyParts body{.name = world.body_name,
                 .skin = world.skin,
                 .closed = world.closed,
                 .self_intersecting = world.surface.self_intersecting,
                 .anatomy = world.anatomy,
                 .notes = world.body_notes,
                 .texture = world.texture,
                 .channels = world.channels,
                 .given_stiffness_n_per_mm = world.given_stiffness_n_per_mm,
                 .given_layers = world.given_layers};
  return withBody(scene, std::move(body), formsOf(scene), progress);
}

contact::FingerSettings contactSettings(const Scene& scene, const Finger& finger) {
  contact::FingerSettings settings = scene.contact.finger;
  settings.radius_mm = finger.radius_mm;
  settings.tick_s = 1.0 / scene.ticks_per_s;
  settings.relaxation = scene.tissue.relaxation;
  return settings;
}

}  // namespace palpate::scene
