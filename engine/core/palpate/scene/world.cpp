// Builds a world in the order in which its parts need each other:
//
//   scene ─ forms (their files first) ─► body: geometry of contact, deformable skin, bones (body.h)
//   body, key points ─► healthy tissue ─ dysfunctions ─► surface ─► lumps ─► detecting box, where asked for ─► World
//                            └─► reach of regions ──────────────────────────────────────────────────────────▲
//   key points ─► ellipses, contours ─────────────────────────────────────────────────────────────────────┘
//
// `rebuilt` starts behind the body, and takes over what its settings leave as it is.
#include "palpate/scene/world.h"
#include "palpate/scene/tissue_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/base/error.h"
#include "palpate/body/places.h"
#include "palpate/deform/shear_limit.h"
#include "palpate/scene/anatomical_reach.h"
#include "palpate/scene/body_parts.h"
#include "palpate/scene/hdb_source.h"
#include "palpate/scene/healthy_tissue.h"
#include "palpate/scene/lumps_of_body.h"
#include "palpate/scene/place_curves.h"
#include "palpate/scene/skin_channels.h"
#include "palpate/tissue/user_profile.h"

namespace palpate::scene {

namespace {

using KeyPoints = std::vector<maps::KeyPoint>;

// ---- ellipses

/// Radius of the basic circle where the scene says none: the dissertation's 150 mm on a back, and on other bodies no
/// more than this share of their diagonal.
constexpr double kBackRadiusMm = 150.0;
constexpr double kRadiusOfDiagonal = 0.15;

/// The user's, or on a built-in body the dissertation's; a mesh has none of its own.
KeyPoints loadKeyPoints(const Scene& scene) {
  if (!scene.ellipses.key_points.empty()) return maps::readKeyPoints(scene.ellipses.key_points);
  if (scene.body.kind == BodyKind::mesh) return {};
  maps::MeasuredDataChoice measured = scene.ellipses.measured;
  if (scene.fidelity.literal(Erratum::E30_key_averages)) measured.averaging = maps::Averaging::plain;
  return maps::dissertationKeyPoints(measured);
}

maps::EllipseMapSettings ellipseMapSettings(const Scene& scene, const Body& body) {
  maps::EllipseMapSettings settings = scene.ellipses.map;
  if (scene.ellipses.basic_radius_mm > 0.0) {
    settings.basic_radius_mm = scene.ellipses.basic_radius_mm;
  } else if (scene.body.kind == BodyKind::mesh) {
    settings.basic_radius_mm = std::min(kBackRadiusMm, kRadiusOfDiagonal * body.box.diagonal().norm());
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

/// A finger that slides over a steep place gets its force in steps, whatever the loop does
/// (docs/explanation/safety.md).
void noteSteepMap(const mesh::TriangleMesh& skin, const SteepPlace& steep, double tick_s,
                  std::vector<std::string>& notes) {
  constexpr double kDepth = 3.0;
  constexpr double kSpeed = 100.0;   // mm/s
  constexpr double kFeltStep = 0.3;  // N in a tick
  const double step_n = steep.n_per_mm_in_a_mm * kDepth * kSpeed * tick_s;
  if (step_n <= kFeltStep) return;
  const Vec3 place = mesh::centreOf(skin, skin.triangles[steep.triangle]);
  notes.push_back(
      fmt::format("the stiffness changes by {:.2g} N/mm within 1 mm at ({:.0f}, {:.0f}, {:.0f}) mm: a finger sliding "
                  "there, {} mm deep at {} mm/s, feels steps of {:.2g} N; spread the change over at least 5 mm",
                  steep.n_per_mm_in_a_mm, place.x(), place.y(), place.z(), kDepth, kSpeed, step_n));
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

std::shared_ptr<const hdb::HdbSurface> makeDetectingBox(const Scene& scene, const mesh::TriangleMesh& skin,
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
        fmt::format("finger '{}': the layered force for a radius of {:g} mm is that for {:g} mm, the nearest radius "
                    "that was solved",
                    finger.name, finger.radius_mm, counts_as));
  }
}

// ---- what lies under it

/// Null unless a lump or a finger's pad needs them. Reuses the previous world's patterns if the tissue is the same.
std::shared_ptr<const contact::PressureGround> pressureIfAsked(const Scene& scene, const HealthyTissue& healthy,
                                                               bool layered, const World* before,
                                                               std::vector<std::string>& notes) {
  const auto padded = std::ranges::find_if(scene.fingers, [](const Finger& finger) { return finger.pad > 0; });
  if (scene.lumps.empty() && padded == scene.fingers.end()) return nullptr;
  const bool same = before != nullptr && before->pressure && before->healthy.get() == &healthy;
  if (same && before->scene.tissue.layer_table == scene.tissue.layer_table) return before->pressure;
  try {
    return pressureGround(LumpGround(scene, healthy, layered, "pressure pads"));
  } catch (const Error& error) {
    if (!scene.lumps.empty()) throw;
    notes.push_back(fmt::format("finger '{}': no pressure is computed for its pad: {}", padded->name, error.what()));
    return nullptr;
  }
}

// ---- what is seen

void noteUnknownScalar(const Scene& scene, const SkinChannels* channels, std::vector<std::string>& notes) {
  if (scene.view.scalar.empty() || scalarNamed(channels, scene.view.scalar) != nullptr) return;
  notes.push_back(fmt::format("[view] scalar \"{}\": the mesh file has no such vertex value; it has {}",
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
      "[safety] slew_per_motion, slew_mm and passivity_allowance_n_mm no longer have an effect; remove them "
      "(docs/explanation/safety.md)");
}

// ---- how it moves

std::optional<body::BreathField> makeBreath(const Scene& scene, const Body& body, std::vector<std::string>& notes) {
  if (!scene.breathing.on) return std::nullopt;
  const double front_z = body.box.min().z();
  auto breath = body::BreathField::of(scene.breathing, body.anatomy.landmarks, body.anatomy.support, front_z);
  if (!breath)
    notes.emplace_back("[breathing] has no effect: it requires a body with a known spine (built-in or fitted)");
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
  /// For a table with a line in a scene file, which errors then name.
  const auto find_for = [&](const auto& table, double& x_mm, double& y_mm) {
    try {
      find(table.at, x_mm, y_mm);
    } catch (const Error& error) {
      if (table.line == 0) throw;
      throw Error::atLine(table.scene_file, table.line, error.what());
    }
  };
  for (LumpSettings& lump : scene.lumps) find_for(lump, lump.x_mm, lump.y_mm);
  for (Finger& finger : scene.fingers) find_for(finger, finger.at_mm.x(), finger.at_mm.y());
  return scene;
}

/// The thickness up to which parts must be measured, mm, so that the deepest press does not come out of the far side
/// of a thin one. Nothing where thickness does not limit a press, or where the tissue over the bones does.
std::optional<double> thicknessLimit(const deform::FormSettings& forms, bool layered) {
  if (layered || !forms.common.limit_shear) return std::nullopt;
  return forms.common.tissue.normal_cap_mm / deform::ShearLimit::kShareOfThickness;
}

/// A deformable skin beside the body's own; its triangles are the body's.
struct OwnSkin {
  std::shared_ptr<const Body> body;
  deform::Skin skin;
};

std::shared_ptr<const deform::Skin> makeDeformable(const std::shared_ptr<const Body>& body,
                                                   const deform::FormSettings& forms, bool layered,
                                                   const World* before) {
  const std::optional<double> limit_mm = thicknessLimit(forms, layered);
  if (limit_mm == body->thickness_limit_mm) return {body, &body->deformable};
  if (before != nullptr && thicknessLimit(before->deformation, before->layered != nullptr) == limit_mm) {
    return before->deformable;
  }
  const auto own = std::make_shared<OwnSkin>(OwnSkin{body, body->deformable});
  setThickness(limit_mm ? thicknessOf(*body, *limit_mm) : std::vector<float>{}, own->skin);
  return {own, &own->skin};
}

std::shared_ptr<const AnatomicalReach> reachFor(const Scene& scene, const Body& body, const HealthyTissue& healthy,
                                                const World* before) {
  const bool same = before != nullptr && before->healthy.get() == &healthy && healthy.tissue.layered;
  if (same) return before->reach;
  return reachOf(scene, body.skin, body.anatomy, body.geometry->tree, healthy.tissue.layered.get());
}

/// Returns half of each stiffness: what a haptic surface leaves that gives way as far as the tip goes on.  // (2.3)
std::shared_ptr<const std::vector<double>> halved(std::vector<double> stiffness_n_per_mm) {
  for (double& k : stiffness_n_per_mm) k *= 0.5;
  return std::make_shared<const std::vector<double>>(std::move(stiffness_n_per_mm));
}

/// `before`: a world of the same body, or null.
std::shared_ptr<const World> assembleWorld(const Scene& asked, std::shared_ptr<const Body> body,
                                           deform::FormSettings forms, const World* before, const Progress& progress) {
  const Scene scene = withPlaces(asked, body->anatomy.landmarks);
  const KeyPoints keys = loadKeyPoints(scene);
  report(progress, "mapping stiffness", 0.0);
  std::vector<std::string> notes = body->notes;
  noteUnknownScalar(scene, body->channels.get(), notes);
  noteOldLimits(scene.safety, notes);
  TissueChoice choice = tissueChoice(scene, forms, !body->anatomy.depth_mm.empty());
  auto healthy = healthyTissue(scene, *body, choice.model, keys, before == nullptr ? nullptr : before->healthy);
  notes.insert(notes.end(), healthy->notes.begin(), healthy->notes.end());
  report(progress, "mapping stiffness", 0.5);  // between long steps, so that the caller can cancel
  DiseasedStiffness stiffness = diseasedStiffness(scene, *body, *healthy, notes);
  if (scene.contact.haptic_surface == HapticSurface::yields) stiffness.n_per_mm = halved(*stiffness.n_per_mm);
  if (std::string note = tissueNote(scene, choice, *stiffness.n_per_mm); !note.empty()) {
    notes.push_back(std::move(note));
  }
  noteSteepMap(body->skin, stiffness.steepest, 1.0 / scene.ticks_per_s, notes);
  auto place_curves = placeCurvesOf(scene, forms, notes);
  const std::optional<body::BreathField> breath = makeBreath(scene, *body, notes);
  report(progress, "mapping stiffness", 0.8);
  contact::Surface surface =
      contact::surfaceOf(body->geometry, std::move(stiffness.n_per_mm),
                         {.force_law = forceLaw(scene, healthy->tissue), .tissue_mm = healthy->tissue.felt_mm});
  surface.planes = body->planes;
  noteFingers(scene, surface.force_law, notes);
  const bool has_layers = choice.model == TissueModel::layered;
  auto lumps = placedLumps({scene, *body, *healthy, surface, has_layers, before}, notes);
  surface.lumps = feltLumps(lumps);
  auto pressure = pressureIfAsked(scene, *healthy, has_layers, before, notes);
  auto hdb = makeDetectingBox(scene, body->skin, surface, progress);

  report(progress, "preparing the deformation", 0.0);
  const std::shared_ptr<const tissue::LayeredTissue> layered = healthy->tissue.layered;
  auto deformable = makeDeformable(body, forms, layered != nullptr, before);
  report(progress, "preparing the deformation", 0.5);
  const maps::EllipseMapSettings map_settings = ellipseMapSettings(scene, *body);
  maps::AnyEllipseMap ellipses(keys, map_settings, literalMapForms(scene));
  auto contours = contoursOf(scene, map_settings);
  auto reach = reachFor(scene, *body, *healthy, before);

  return std::make_shared<const World>(World{.scene = scene,
                                             .body = std::move(body),
                                             .surface = std::move(surface),
                                             .deformable = std::move(deformable),
                                             .ellipses = std::move(ellipses),
                                             .deformation = std::move(forms),
                                             .contours = std::move(contours),
                                             .layered = layered,
                                             .reach = std::move(reach),
                                             .place_curves = std::move(place_curves),
                                             .breath = breath,
                                             .notes = std::move(notes),
                                             .hdb = std::move(hdb),
                                             .healthy = std::move(healthy),
                                             .tissue = std::move(choice),
                                             .lumps = std::move(lumps),
                                             .pressure = std::move(pressure)});
}

std::shared_ptr<const World> firstWorld(const Scene& scene, BodyParts parts, deform::FormSettings forms,
                                        const Progress& progress) {
  raiseSkin(scene, parts);
  const bool has_bones = !parts.anatomy.depth_mm.empty();
  const bool layered = tissueChoice(scene, forms, has_bones).model == TissueModel::layered;
  auto body = builtBody(std::move(parts), thicknessLimit(forms, layered), progress);
  return assembleWorld(scene, std::move(body), std::move(forms), nullptr, progress);
}

}  // namespace

std::shared_ptr<const World> build(const Scene& scene, const Progress& progress) {
  checkContactSource(scene);
  deform::FormSettings forms = formsOf(scene);  // first: a fault in its files should not wait for the body
  return firstWorld(scene, makeBody(scene.body, progress), std::move(forms), progress);
}

std::shared_ptr<const World> buildOn(const Scene& scene, BodyParts body, const Progress& progress) {
  checkContactSource(scene);
  return firstWorld(scene, std::move(body), formsOf(scene), progress);
}

std::shared_ptr<const World> rebuilt(const World& world, const Scene& scene, const Progress& progress) {
  if (haveEqualSwellings(world.scene, scene)) return rebuiltOnItsSkin(world, scene, progress);
  Scene raised = scene;
  raised.body = world.scene.body;
  return build(raised, progress);
}

std::shared_ptr<const World> rebuiltOnItsSkin(const World& world, const Scene& scene, const Progress& progress) {
  if (!haveEqualSwellings(world.scene, scene))
    throw Error("a changed swelling changes the skin; build a new world (scene::build)");
  return assembleWorld(scene, world.body, formsOf(scene), &world, progress);
}

contact::FingerSettings contactSettings(const Scene& scene, const Finger& finger) {
  contact::FingerSettings settings = scene.contact.finger;
  settings.radius_mm = finger.radius_mm;
  settings.tick_s = 1.0 / scene.ticks_per_s;
  settings.relaxation = scene.tissue.relaxation;
  return settings;
}

}  // namespace palpate::scene
