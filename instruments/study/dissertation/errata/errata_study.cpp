// A scene is run for each reading, headless, and compared with the corrected run tick by tick; the skins at 20 pictures
// a second. Runs to compare with are kept, one without a partition and one for each tree.
// Based on: Ji, dissertation 2008, and its errata E1 to E34 (docs/reference/dissertation.md).
#include "dissertation/errata/errata_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "palpate/deform/contact.h"
#include "palpate/device/finger_path.h"
#include "palpate/engine/living_skin.h"
#include "palpate/scene/skin_contact.h"
#include "palpate/scene/words.h"
#include "palpate/scene/world.h"
#include "palpate/servo/loop.h"
#include "palpate/servo/scripted_rig.h"

namespace palpate::study {

namespace {

/// 20 pictures a second of a 1 kHz scene show every move of a finger.
constexpr std::size_t kTicksAPicture = 50;

/// Another reading of one erratum.
struct Reading {
  Erratum erratum;
  std::string_view words;
  std::function<void(scene::Scene&)> apply;
};

/// Readings that are settings rather than switches of fidelity.
const std::vector<Reading>& settingReadings() {
  static const std::vector<Reading> readings = {
      {Erratum::E2_drag_spring, "friction.stiffness_ratio = 0.23",
       [](scene::Scene& s) { s.contact.finger.stiffness_ratio = 0.23; }},
      {Erratum::E20_zero_boundary, "deformation.boundary = \"two_mm\"",
       [](scene::Scene& s) { s.deformation.forms.boundary = deform::Boundary::two_mm; }},
      {Erratum::E24_pure_shear, "strain.kind = \"principal\"",
       [](scene::Scene& s) { s.strain.kind = deform::StrainKind::principal; }},
      {Erratum::E25_two_fingers, "deformation.together = \"summed\"",
       [](scene::Scene& s) { s.deformation.forms.together = deform::Together::summed; }},
      {Erratum::E30_key_averages, "ellipses.averaging = \"tensorial\"",
       [](scene::Scene& s) { s.ellipses.measured.averaging = maps::Averaging::tensorial; }},
      {Erratum::E31_down_like_up, "ellipses.data = \"down\"",
       [](scene::Scene& s) { s.ellipses.measured.force = maps::ForceDirection::down; }},
  };
  return readings;
}

/// Collision geometry of a finger: the whole skin, or the triangles that a tree gives.
using Base = std::optional<hdb::TreeKind>;
const std::array<Base, 3> kBases{std::nullopt, hdb::TreeKind::Bsp, hdb::TreeKind::Octree};

/// Where an erratum of the partition acts alone; nothing for the others, which any base shows.
Base baseFor(Erratum erratum) {
  switch (erratum) {
    case Erratum::E4_else_if:
    case Erratum::E5_cell_box:
    case Erratum::E7_leaf_threshold:
    case Erratum::E10_half_spaces:
    case Erratum::E12_box_edges:
      return hdb::TreeKind::Bsp;
    case Erratum::E6_three_octants:
    case Erratum::E11_sphere_corners:
      return hdb::TreeKind::Octree;
    default:
      return std::nullopt;
  }
}

/// The errata whose switch has no place under these options. Each tree has one printed search at a time: ELSEIF goes
/// before the other forms of the BSP tree, the node's box before the sphere of the octree (hdb/literal_traversal.h).
std::string inertErrata(const Base& base) {
  if (!base) return "E4, E5, E6, E7, E10, E11, E12";
  return *base == hdb::TreeKind::Bsp ? "E5, E6, E10, E11" : "E4, E10, E11";
}

std::string describeBase(const Base& base) {
  if (!base) return "contact.source = \"surface\"";
  return fmt::format("contact.source = \"hdb\", partition.tree = \"{}\", radius_mm = 0", wordFor(*base));
}

void name(ErratumEffect& effect, const Base& base, const scene::World& world) {
  effect.body = world.body->name;
  effect.tissue = scene::describe(world.tissue);
  effect.base = base ? wordFor(*base) : wordFor(scene::ContactSource::surface);
  effect.active = describeBase(base);
}

/// Reference for a reading: the scene corrected, in the tissue that the errata are about, and for the partition with
/// the source that has one.
scene::Scene corrected(scene::Scene scene, const Base& base) {
  scene.fidelity = {};
  scene.deformation.tissue = scene::TissueModel::gaussian;
  scene.contact.source = base ? scene::ContactSource::hdb : scene::ContactSource::surface;
  if (!base) return scene;
  scene.partition.build.tree = *base;
  for (scene::Finger& finger : scene.fingers) finger.radius_mm = 0.0;
  return scene;
}

/// A whole run: every finger at every tick.
struct Track {
  std::shared_ptr<const scene::World> world;
  std::vector<contact::FingerOutput> outputs;  // ticks x fingers
  std::size_t fingers = 0;
  std::span<const contact::FingerOutput> tick(std::size_t i) const { return {&outputs[i * fingers], fingers}; }
  std::size_t ticks() const { return fingers == 0 ? 0 : outputs.size() / fingers; }
};

Track recordTrack(const scene::Scene& scene) {
  Track track;
  track.world = scene::build(scene);
  track.fingers = scene.fingers.size();
  const device::FingerPaths paths = device::pathsOf(*track.world);
  servo::Rig rig = servo::scriptedRig(*track.world, paths);
  servo::runHeadless(rig, paths.ticks, [&](std::span<const trace::Sample> samples) {
    for (const trace::Sample& sample : samples) track.outputs.push_back(sample.contact);
  });
  return track;
}

/// The skin of a run, picture by picture.
class Pictures {
 public:
  explicit Pictures(const Track& track) : track_(track), skin_(*track.world) {}

  const deform::DeformedSurface& at(std::size_t tick) {
    moved_ += skin_.follow(track_.tick(tick)).moved_vertices;
    return skin_.surface();
  }
  std::size_t moved() const { return moved_; }

 private:
  const Track& track_;
  engine::LivingSkin skin_;
  std::size_t moved_ = 0;
};

void compareFingers(const Track& ours, const Track& theirs, ErratumEffect& effect) {
  for (std::size_t i = 0; i < std::min(ours.outputs.size(), theirs.outputs.size()); ++i) {
    const contact::FingerOutput& a = ours.outputs[i];
    const contact::FingerOutput& b = theirs.outputs[i];
    effect.force_n = std::max(effect.force_n, (a.force - b.force).norm());
    effect.proxy_mm = std::max(effect.proxy_mm, (a.proxy - b.proxy).norm());
    const bool touches[] = {a.touch != contact::Touch::free, b.touch != contact::Touch::free};
    if (touches[0] != touches[1]) ++effect.lost_ticks;
  }
}

double dragOf(const scene::World& world, const contact::FingerOutput& finger) {
  const std::optional<deform::Contact> contact = scene::contactOf(world, finger);
  if (!contact) return 0.0;
  const deform::TissueSettings& tissue = world.deformation.common.tissue;
  const Vec3 along_the_skin = contact->drag_mm - contact->drag_mm.dot(finger.normal) * finger.normal;
  return deform::cappedLength(tissue.f_adj * along_the_skin, tissue.tangential_cap_mm).norm();
}

RunLook summariseRun(const Track& track) {
  RunLook look;
  double touching = 0.0;
  for (const contact::FingerOutput& finger : track.outputs) {
    if (finger.touch == contact::Touch::free) continue;
    touching += 1.0;
    look.peak_force_n = std::max(look.peak_force_n, finger.force.norm());
    look.drag_mm = std::max(look.drag_mm, dragOf(*track.world, finger));
  }
  if (!track.outputs.empty()) look.touching_percent = 100.0 * touching / static_cast<double>(track.outputs.size());
  return look;
}

/// Triangles in the box round a proxy, ascending.
std::vector<Index> trianglesInBox(hdb::HdbCandidates& candidates, const Box3& box) {
  candidates.refresh(box.center());
  std::vector<Index> triangles = candidates.near(box);
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

void compareBoxes(const Track& ours, const Track& theirs, ErratumEffect& effect) {
  if (!ours.world->hdb || !theirs.world->hdb) return;
  hdb::HdbCandidates all(ours.world->hdb);
  hdb::HdbCandidates some(theirs.world->hdb);
  const Vec3 half = 0.5 * ours.world->hdb->settings.edges_mm;
  for (std::size_t tick = 0; tick < ours.ticks(); tick += kTicksAPicture) {
    for (const contact::FingerOutput& finger : ours.tick(tick)) {
      const Box3 box(finger.proxy - half, finger.proxy + half);
      const auto wanted = trianglesInBox(all, box);
      const auto found = trianglesInBox(some, box);
      std::vector<Index> missed;
      std::set_difference(wanted.begin(), wanted.end(), found.begin(), found.end(), std::back_inserter(missed));
      if (missed.empty()) continue;
      effect.missed_percent = std::max(effect.missed_percent,
                                       100.0 * static_cast<double>(missed.size()) / static_cast<double>(wanted.size()));
    }
  }
}

/// Sums over the vertices that move in one of the two.
struct SkinSums {
  double squares = 0.0;
  double count = 0.0;
};

void compareSkins(const deform::DeformedSurface& a, const deform::DeformedSurface& b, SkinSums& sums,
                  ErratumEffect& effect) {
  for (Index v = 0; v < a.vertices(); ++v) {
    const Vec3f of_a = a.displacementAt(v);
    const Vec3f of_b = b.displacementAt(v);
    if (of_a.isZero(0.0f) && of_b.isZero(0.0f)) continue;
    const double apart = (of_a - of_b).norm();
    effect.skin_mm = std::max(effect.skin_mm, apart);
    sums.squares += apart * apart;
    sums.count += 1.0;
    effect.strain_percent =
        std::max(effect.strain_percent, 100.0 * std::abs(static_cast<double>(a.strain()[v]) - b.strain()[v]));
  }
}

ErratumEffect compared(const Track& ours, const Track& theirs) {
  ErratumEffect effect;
  effect.look = summariseRun(theirs);
  compareFingers(ours, theirs, effect);
  compareBoxes(ours, theirs, effect);
  Pictures our_pictures(ours);
  Pictures their_pictures(theirs);
  SkinSums sums;
  for (std::size_t tick = 0; tick < std::min(ours.ticks(), theirs.ticks()); tick += kTicksAPicture) {
    compareSkins(our_pictures.at(tick), their_pictures.at(tick), sums, effect);
  }
  effect.skin_rms_mm = sums.count > 0.0 ? std::sqrt(sums.squares / sums.count) : 0.0;
  const auto moved = static_cast<double>(our_pictures.moved());
  if (moved > 0.0) effect.moved_ratio = static_cast<double>(their_pictures.moved()) / moved;
  return effect;
}

/// The runs that readings are compared with; each is made when it is first needed.
class Baselines {
 public:
  explicit Baselines(const scene::Scene& scene) : scene_(scene) {}
  const Track& track(const Base& base) {
    Track& track = tracks_[base ? 1 + static_cast<std::size_t>(*base) : 0];
    if (!track.world) track = recordTrack(corrected(scene_, base));
    return track;
  }

 private:
  const scene::Scene& scene_;
  std::array<Track, kBases.size()> tracks_;
};

ErratumEffect measureEffect(const scene::Scene& scene, Baselines& baselines, const Base& base, const Reading& reading) {
  scene::Scene other = corrected(scene, base);
  reading.apply(other);
  const Track theirs = recordTrack(other);
  ErratumEffect effect = compared(baselines.track(base), theirs);
  effect.reading = reading.words;
  name(effect, base, *theirs.world);
  return effect;
}

Reading literalReading(Erratum erratum) {
  return {erratum, "", [erratum](scene::Scene& s) { s.fidelity.setLiteral(erratum); }};
}

ErratumEffect measureEffect(const scene::Scene& scene, Baselines& baselines, const scene::ErratumText& text) {
  ErratumEffect effect;
  const Base base = baseFor(text.erratum);
  if (text.form == scene::LiteralForm::switchable) {
    effect = measureEffect(scene, baselines, base, literalReading(text.erratum));
    effect.reading = fmt::format("fidelity.{} = \"literal\"", scene::nameOf(text.erratum));
  }
  for (const Reading& reading : settingReadings()) {
    if (reading.erratum == text.erratum) effect = measureEffect(scene, baselines, base, reading);
  }
  effect.text = text;
  return effect;
}

ErratumEffect effectOfNone(Baselines& baselines, const Base& base) {
  ErratumEffect effect;
  effect.look = summariseRun(baselines.track(base));
  effect.reading = "fidelity = \"corrected\"";
  name(effect, base, *baselines.track(base).world);
  effect.text.ours = "what the rows below with these options are compared with";
  return effect;
}

ErratumEffect effectOfAll(const scene::Scene& scene, Baselines& baselines, const Base& base) {
  const Reading all{Erratum::none, "fidelity = \"literal\"", [](scene::Scene& s) { s.fidelity.setAll(true); }};
  ErratumEffect effect = measureEffect(scene, baselines, base, all);
  effect.text.ours = "all switches together";
  effect.inert = inertErrata(base);
  return effect;
}

}  // namespace

ErrataEffects studyErrata(const scene::Scene& scene, const Progress& progress) {
  Baselines baselines(scene);
  ErrataEffects effects;
  report(progress, "measuring errata", 0.0);
  for (const Base& base : kBases) {
    effects.corrected.push_back(effectOfNone(baselines, base));
    effects.all_literal.push_back(effectOfAll(scene, baselines, base));
  }
  for (const scene::ErratumText& text : scene::errata()) {
    effects.errata.push_back(measureEffect(scene, baselines, text));
    report(progress, "measuring errata", static_cast<double>(numberOf(text.erratum)) / kErrata);
  }
  return effects;
}

}  // namespace palpate::study
