#include "palpate/scene/scene_keys.h"

#include <algorithm>
#include <cctype>

#include "palpate/hdb/literal_traversal.h"
#include "palpate/scene/section_keys.h"

namespace palpate::scene {

namespace {

/// A length that is longer than any body, and short enough that its square keeps all its digits.
constexpr double kLongestMm = 1e5;

template <class S>
std::vector<KeyRow> describe(const std::string& title, const std::vector<Key<S>>& keys, const S& defaults = {}) {
  std::vector<KeyRow> rows;
  rows.reserve(keys.size());
  for (const Key<S>& key : keys)
    rows.push_back({title, key.name, key.takes, key.show(defaults), key.meaning, key.form});
  return rows;
}

const toml::table& tableOf(const Entry& entry) {
  if (const toml::table* table = entry.node.as_table()) return *table;
  entry.fail("must be a table");
}

/// A table that stands once.
template <class S>
Section section(const std::string& name, const std::string& about, Access<Scene, S> at, std::vector<Key<S>> keys,
                std::function<void(const S&, const Entry&)> check = {}) {
  const std::string title = "[" + name + "]";
  const auto read = [=](Scene& scene, const Entry& entry) {
    readTable(tableOf({entry.node, entry.file, title}), title, entry.file, keys, at(scene));
    if (check) check(at(scene), {entry.node, entry.file, title});
  };
  const auto rows = [=](const Scene& scene) { return describe(title, keys, valueOf<Scene, S>(at, scene)); };
  return {name,
          title,
          about,
          read,
          [=] { return rows({}); },
          [=](const Scene& scene) { return std::vector<std::vector<KeyRow>>{rows(scene)}; }};
}

/// A table that stands as often as one likes.
template <class S>
Section listSection(const std::string& name, const std::string& about, Access<Scene, std::vector<S>> at,
                    std::function<S(const toml::table&, const Entry&)> read_one, const std::vector<Key<S>>& keys,
                    std::function<std::vector<KeyRow>()> describe_rows) {
  const std::string title = "[[" + name + "]]";
  const auto read = [=](Scene& scene, const Entry& entry) {
    const toml::array* list = entry.node.as_array();
    if (list == nullptr) Entry{entry.node, entry.file, title}.fail("must be written with two brackets");
    for (const toml::node& node : *list) {
      const Entry one{node, entry.file, title};
      at(scene).push_back(read_one(tableOf(one), one));
    }
  };
  const auto values = [=](const Scene& scene) {
    std::vector<std::vector<KeyRow>> rows;
    for (const S& one : valueOf<Scene, std::vector<S>>(at, scene)) rows.push_back(describe(title, keys, one));
    return rows;
  };
  return {name, title, about, read, std::move(describe_rows), values};
}

/// Remembers where it stands: what is wrong with the picture is found when the body is built.
Key<BodySettings> textureKey() {
  using S = BodySettings;
  Key<S> key = file<S>(
      "texture", [](S& s) -> std::filesystem::path& { return s.texture.file; },
      "Mesh: a PNG or JPEG picture that lies on the skin by the file's texture coordinates (OBJ, glTF, GLB); or a glTF "
      "or GLB file, for its base colour picture.");
  key.read = [read = std::move(key.read)](S& s, const Entry& entry) {
    read(s, entry);
    s.texture.scene_file = entry.file;
    s.texture.line = entry.line();
  };
  return key;
}

Section bodySection() {
  using S = BodySettings;
  std::vector<Key<S>> keys = {
      choice<S, BodyKind>("kind", &S::kind, {"torso", "mesh"}, "The built-in torso with its bones, or a mesh file."),
      count<S>(
          "triangles", [](S& s) -> std::size_t& { return s.torso.triangles; }, 5000, 4'000'000,
          "Torso: of skin and bones together; 8163, 20389 and 41582 are the dissertation's sizes."),
      number<S>(
          "stature_mm", [](S& s) -> double& { return s.torso.shape.stature_mm; }, between(500, 2500),
          "Torso: how tall the whole person is."),
      number<S>(
          "spine_relief", [](S& s) -> double& { return s.torso.shape.relief.spine; }, between(0, 3),
          "Torso: how far the spinous processes show on the skin; 0 is not at all, 1 a lean standing man."),
      number<S>(
          "rib_relief", [](S& s) -> double& { return s.torso.shape.relief.ribs; }, between(0, 3),
          "Torso: the same for the ribs."),
      number<S>(
          "scapula_relief", [](S& s) -> double& { return s.torso.shape.relief.scapulae; }, between(0, 3),
          "Torso: the same for the shoulder blades."),
      number<S>(
          "asymmetry", [](S& s) -> double& { return s.torso.shape.asymmetry; }, between(0, 3),
          "Torso: natural differences of left and right; 0 is a mirror image."),
      file<S>("file", &S::file, "Mesh: OBJ, STL, PLY, OFF, glTF or GLB, relative to the scene file."),
      choice<S, Unit>("unit", &S::unit, {"auto", "mm", "cm", "dm", "m", "in"},
                      "Mesh: the unit of the file; auto is m for glTF and GLB, mm for the others."),
      number<S>("scale", &S::scale, above(0, 1e6), "Mesh: factor on its size, after the unit."),
      text<S>("group", &S::group, "Mesh: only this group or object of an OBJ file."),
      flag<S>("repair", &S::repair, "Mesh: mend what can be mended; false refuses a mesh that is not fit."),
      textureKey(),
  };
  return section<S>("body", "What is touched.", &Scene::body, std::move(keys), [](const S& body, const Entry& entry) {
    if (body.kind == BodyKind::mesh && body.file.empty()) entry.fail("of kind \"mesh\" needs a file");
    if (body.kind == BodyKind::torso && !body.file.empty()) entry.fail("has a file but is not of kind \"mesh\"");
    if (body.kind == BodyKind::torso && !body.texture.file.empty())
      entry.fail("has a texture but is not of kind \"mesh\"");
  });
}

Section stiffnessSection() {
  using S = StiffnessSettings;
  std::vector<Key<S>> keys = {
      choice<S, StiffnessSource>(
          "source", &S::source, {"auto", "depth", "points", "constant"},
          "Depth of the bones, key points with a stiffness, or the same everywhere; auto is depth "
          "on the torso and constant on a mesh."),
      number<S>("constant_n_per_mm", &S::constant_n_per_mm, above(0, 100), "The stiffness for source \"constant\"."),
      number<S>(
          "soft_n_per_mm", [](S& s) -> double& { return s.depth.soft_n_per_mm; }, above(0, 100),
          "Source \"depth\": far from any bone."),
      number<S>(
          "stiff_n_per_mm", [](S& s) -> double& { return s.depth.stiff_n_per_mm; }, above(0, 100),
          "Source \"depth\": where bone lies right under the skin."),
      number<S>(
          "fade_mm", [](S& s) -> double& { return s.depth.fade_mm; }, above(0, 1000),
          "Source \"depth\": over this depth the difference falls to 37 %."),
      number<S>(
          "basic_n_per_mm", [](S& s) -> double& { return s.points.basic_n_per_mm; }, above(0, 100),
          "Source \"points\": where no key point reaches."),
      number<S>(
          "effect_radius_mm", [](S& s) -> double& { return s.points.effect_radius_mm; }, above(0, kLongestMm),
          "Source \"points\": how far a key point reaches."),
      choice<S, maps::StiffnessInterpolation>(
          "interpolation", [](S& s) -> maps::StiffnessInterpolation& { return s.points.interpolation; },
          {"gri", "thin_plate", "polynomial"},
          "Source \"points\": through every point and never beyond them; through every point and smoothest; or the "
          "trend."),
      count<S>(
          "polynomial_degree", [](S& s) -> std::size_t& { return s.points.polynomial_degree; }, 0,
          maps::kMaxPolynomialDegree, "Source \"points\", interpolation \"polynomial\": its degree."),
  };
  return section<S>("stiffness", "How hard the body pushes back, in N per mm of depth.", &Scene::stiffness,
                    std::move(keys));
}

Section dysfunctionSection() {
  using S = maps::Dysfunction;
  const std::vector<Key<S>> keys = {
      number<S>("x_mm", &S::x_mm, between(-kLongestMm, kLongestMm), "Centre, seen along z."),
      number<S>("y_mm", &S::y_mm, between(-kLongestMm, kLongestMm), "Centre, seen along z."),
      number<S>("radius_mm", &S::radius_mm, above(0, kLongestMm), "Outside nothing changes."),
      number<S>("change_percent", &S::change_percent, between(-100, 10000), "Change of the stiffness at the centre."),
      number<S>("edge_softness", &S::edge_softness, between(0, 1),
                "Share of the radius over which the change fades out; 0 is a hard edge."),
  };
  const auto read = [keys](const toml::table& table, const Entry& entry) {
    S dysfunction;
    readTable(table, entry.name, entry.file, keys, dysfunction);
    return dysfunction;
  };
  return listSection<S>("dysfunction", "A place that is stiffer or softer than it should be.", &Scene::dysfunctions,
                        read, keys, [keys] { return describe<S>("[[dysfunction]]", keys); });
}

Section ellipsesSection() {
  using S = EllipseSettings;
  std::vector<Key<S>> keys = {
      file<S>("key_points", &S::key_points,
              "Table of measured ellipses (docs/maps.md); left out: the dissertation's means on the torso, none on a "
              "mesh."),
      choice<S, maps::ForceDirection>(
          "data", [](S& s) -> maps::ForceDirection& { return s.measured.force; }, {"up", "down"},
          "Without key points: the dissertation's means of the skin dragged up, or down."),
      choice<S, maps::Averaging>(
          "averaging", [](S& s) -> maps::Averaging& { return s.measured.averaging; }, {"plain", "tensorial"},
          "Without key points: means of the numbers as printed, or of the ellipses."),
      number<S>(
          "effect_radius_mm", [](S& s) -> double& { return s.map.effect_radius_mm; }, above(0, kLongestMm),
          "How far a key point reaches."),
      number<S>("basic_radius_mm", &S::basic_radius_mm, between(0, kLongestMm),
                "Radius of the circle where no key point reaches; 0 is 150 mm on the torso and at most 15 % of its "
                "diagonal on a mesh."),
  };
  return section<S>("ellipses", "How far the skin follows a dragging finger.", &Scene::ellipses, std::move(keys));
}

Section frictionSection() {
  using S = FrictionSettings;
  std::vector<Key<S>> keys = {
      number<S>("static", &S::mu_static, between(0, 5), "Coefficient up to which the skin sticks to the finger."),
      number<S>("dynamic", &S::mu_dynamic, between(0, 5), "Coefficient while the finger slips; not above static."),
      number<S>("stiffness_ratio", &S::stiffness_ratio, above(0, 100),
                "Tangential over normal stiffness; 0.23 lets the skin follow 20 mm at 10 mm depth."),
  };
  return section<S>("friction", "How the skin holds the finger.", &Scene::friction, std::move(keys),
                    [](const S& friction, const Entry& entry) {
                      if (friction.mu_dynamic > friction.mu_static) entry.fail("dynamic must not be above static");
                    });
}

Section contactSection() {
  using S = ContactSettings;
  std::vector<Key<S>> keys = {
      choice<S, ContactSource>("source", &S::source, {"surface", "hdb"},
                               "What a finger collides with: the whole skin, or only the triangles near the proxy that "
                               "the [partition] gives, as in the dissertation (docs/contact.md)."),
      number<S>("max_depth_mm", &S::max_depth_mm, above(0, kLongestMm),
                "A finger deeper than this looks for a nearer piece of skin; the force grows no further."),
      number<S>(
          "catch_up_mm_per_s", &S::catch_up_mm_per_s, above(0, 1e6),
          "The proxy moves at most twice as far as the tip plus this speed; bounds the change of force at ridges."),
      flag<S>("force_shading", &S::force_shading, "Smooth the force over coarse triangles."),
  };
  return section<S>("contact", "How the finger meets the surface.", &Scene::contact, std::move(keys));
}

std::vector<std::string> traversalWords() {
  std::vector<std::string> words;
  for (const hdb::TraversalWord& row : hdb::kTraversalWords) words.emplace_back(row.word);
  return words;
}

Section partitionSection() {
  using S = PartitionSettings;
  std::vector<Key<S>> keys = {
      choice<S, hdb::TreeKind>("tree", &S::tree, {"bsp", "octree"}, "How space is divided."),
      choice<S, hdb::Assignment>(
          "assign", &S::assign, {"A", "B", "C"},
          "A triangle across a plane is cut (A), goes to both sides (B) or to the side with most of it (C)."),
      count<S>("threshold", &S::threshold, 1, 100'000'000, "A leaf holds at most so many triangles."),
      number<S>("hdb_fraction", &S::hdb_fraction, above(0, 100),
                "Edge of the haptic detecting box as a share of the longest edge of the body."),
      number<S>("hdb_edge_mm", &S::hdb_edge_mm, between(0, kLongestMm), "Edge of that box; 0 is by hdb_fraction."),
      choice<S, hdb::HdbQuery>("query", &S::query, {"leaves", "triangles", "coherent"},
                               "What may be touched: all triangles of the leaves that the box meets, those that it "
                               "meets itself, or a list of these that is made anew only when the box leaves it."),
      choice<S, Traversal>("traversal", &S::traversal, traversalWords(),
                           "How the leaves are found: all of them, or as printed, with its gaps; where it says "
                           "\"tight\", fidelity may still ask for a printed one (E4, E5, E10)."),
      number<S>("refresh_s", &S::refresh_s, between(0, 60),
                "The box follows the proxy every so many seconds; 0 is every tick."),
  };
  return section<S>("partition", "Where a finger of the contact source \"hdb\" finds its triangles.", &Scene::partition,
                    std::move(keys));
}

Section tissueSection() {
  using S = TissueSettings;
  const auto law = [](double tissue::ForceLaw::*member) -> Access<S, double> {
    return [member](S& s) -> double& { return s.force_law.*member; };
  };
  using L = tissue::ForceLaw;
  std::vector<Key<S>> keys = {
      choice<S, L::Kind>(
          "force_law", [](S& s) -> L::Kind& { return s.force_law.kind; }, {"linear", "power", "stiffening", "table"},
          "Normal force by depth (docs/force-laws.md): stiffness times depth; a power of the depth; a stiffness that "
          "grows along a Gaussian; measured."),
      number<S>("exponent", law(&L::exponent), between(1, 3), "Power: of the depth; layered tissue has 1.5 to 1.8."),
      number<S>("reference_depth_mm", law(&L::reference_depth_mm), above(0, 1000),
                "Power: the depth at which it pushes as hard as the linear law."),
      number<S>("stiffening_ratio", law(&L::stiffening_ratio), above(0, 100),
                "Stiffening: the stiffness deep down over that of the map, which is how a light touch feels."),
      number<S>("stiffening_depth_mm", law(&L::stiffening_depth_mm), above(0, 1000),
                "Stiffening: the depth at which that stiffness is reached."),
      file<S>("force_table", &S::force_table,
              "Table: rows depth_mm,force_n, the force being that where the map says 1 N/mm."),
  };
  return section<S>("tissue", "How force grows with depth.", &Scene::tissue, std::move(keys),
                    [](const S& tissue, const Entry& entry) {
                      const bool wants_table = tissue.force_law.kind == L::Kind::table;
                      if (wants_table && tissue.force_table.empty()) entry.fail("law \"table\" needs a force_table");
                      if (!wants_table && !tissue.force_table.empty()) {
                        entry.fail("has a force_table but its force_law is not \"table\"");
                      }
                    });
}

Section deformationSection() {
  return section<DeformationSettings>("deformation", "How the skin gives way (functional shape matched deformation).",
                                      &Scene::deformation, deformationKeys(), checkDeformation);
}

Section strainSection() {
  return section<StrainSettings>("strain", "The colours of the written surfaces.", &Scene::strain, strainKeys());
}

Section outputSection() {
  using S = OutputSettings;
  std::vector<Key<S>> keys = {
      numbers<S>("surfaces_at_s", &S::surfaces_at_s, between(0, 1e6),
                 "Times at which the deformed skin is written, with displacement and strain."),
      flag<S>("forces", &S::forces, "Write forces.csv: every finger in every tick."),
  };
  return section<S>("output", "What is written.", &Scene::output, std::move(keys));
}

Section viewSection() {
  using S = ViewSettings;
  const auto check = [](const S& view, const Entry& entry) {
    if (view.head_mm && !(view.head_mm->z() > 0.0))
      entry.fail("head_mm must be in front of the screen: third number > 0");
  };
  return section<S>("view", "How pictures of it look.", &Scene::view, viewKeys(), check);
}

Section safetySection() {
  using S = SafetySettings;
  std::vector<Key<S>> keys = {
      number<S>("nominal_force_n", &S::nominal_force_n, above(0, 100), "Largest force sent to the device."),
      number<S>("ramp_s", &S::ramp_s, between(0, 60),
                "Forces grow from nothing over this time after a start or a fault."),
      number<S>("slew_per_motion", &S::slew_per_motion, between(0, 1000),
                "The force may change per tick by stiffness times this times the motion of the tip ..."),
      number<S>("slew_mm", &S::slew_mm, above(0, 1000), "... plus stiffness times this, per millisecond."),
      number<S>("max_tip_speed_mm_per_s", &S::max_tip_speed_mm_per_s, above(0, 1e9),
                "A faster tip is a fault of the device: forces ramp up again."),
      flag<S>("passivity", &S::passivity, "Take away push when the skin gives back more energy than it got."),
      number<S>("passivity_allowance_n_mm", &S::passivity_allowance_n_mm, between(0, 1e6),
                "Energy that may be given back before that."),
  };
  return section<S>("safety", "What a device may do to a hand; never changes forces.csv's contact force.",
                    &Scene::safety, std::move(keys));
}

// ---- fingers
// ----------------------------------------------------------------------------------------------------------

const std::vector<std::string> kMoveNames = {"press", "hold", "drag", "circle", "lift"};

/// The keys that a step of one kind takes; what belongs to another kind is an unknown key.
std::vector<Key<Step>> stepKeys(Move move) {
  using S = Step;
  std::vector<Key<S>> keys = {
      choice<S, Move>("do", &S::move, kMoveNames, "What the finger does."),
      number<S>("seconds", &S::seconds, above(0, 3600), "How long it takes."),
  };
  const Range length = between(-kLongestMm, kLongestMm);
  if (move == Move::press)
    keys.push_back(number<S>("depth_mm", &S::depth_mm, length, "Down to this depth in the skin."));
  if (move == Move::lift)
    keys.push_back(number<S>("height_mm", &S::height_mm, length, "Up to this height above the skin."));
  if (move == Move::drag) keys.push_back(point2<S>("by_mm", &S::by_mm, "By this much along x and y."));
  if (move == Move::circle) {
    keys.push_back(number<S>("radius_mm", &S::radius_mm, above(0, kLongestMm), "Round the present place."));
    keys.push_back(number<S>("turns", &S::turns, between(-1000, 1000), "Counter-clockwise; negative is clockwise."));
  }
  return keys;
}

Move moveOf(const toml::table& table, const Entry& entry) {
  const toml::node* word = table.get("do");
  if (word == nullptr) entry.fail(fmt::format("needs do = {}", choiceWords(kMoveNames)));
  return static_cast<Move>(readChoice({*word, entry.file, entry.name + " do"}, kMoveNames));
}

Step readStep(const Entry& entry) {
  const toml::table& table = tableOf(entry);
  Step step;
  const Move move = moveOf(table, entry);
  const std::string title = fmt::format("{} {}", entry.name, kMoveNames[static_cast<std::size_t>(move)]);
  readTable(table, title, entry.file, stepKeys(move), step);
  return step;
}

std::string showStep(const Step& step) {
  std::string words;
  for (const Key<Step>& key : stepKeys(step.move)) {
    words += fmt::format("{}{} = {}", words.empty() ? "" : ", ", key.name, key.show(step));
  }
  return "{ " + words + " }";
}

std::string showScript(const Finger& finger) {
  std::string lines;
  for (const Step& step : finger.steps) lines += "  " + showStep(step) + ",\n";
  return lines.empty() ? lines : "[\n" + lines + "]";
}

Key<Finger> scriptKey() {
  const auto read = [](Finger& finger, const Entry& entry) {
    const toml::array* list = entry.node.as_array();
    if (list == nullptr) entry.fail("must be a list of steps");
    for (const toml::node& node : *list) finger.steps.push_back(readStep({node, entry.file, entry.name}));
  };
  return {"script", "list of steps", "What the finger does, step by step; see below.", read, showScript};
}

std::vector<Key<Finger>> fingerKeys() {
  using S = Finger;
  return {
      text<S>("name", &S::name, "Letters, digits, '-' and '_'; different for each finger."),
      number<S>("radius_mm", &S::radius_mm, between(0, 1000), "0 is a point, 8 a fingertip."),
      file<S>("trajectory", &S::trajectory, "Table t_s,x_mm,y_mm,z_mm; instead of a script."),
      point2<S>("at_mm", &S::at_mm, "Script: the place it starts over, seen along z."),
      number<S>("start_height_mm", &S::start_height_mm, between(-kLongestMm, kLongestMm),
                "Script: height above the skin it starts from."),
      scriptKey(),
  };
}

bool isPlainName(const std::string& name) {
  const auto plain = [](unsigned char c) { return (c < 0x80 && std::isalnum(c) != 0) || c == '-' || c == '_'; };
  return !name.empty() && std::all_of(name.begin(), name.end(), plain);
}

void checkFinger(const Finger& finger, const Entry& entry) {
  if (finger.name.empty()) entry.fail("needs a name");
  if (!isPlainName(finger.name)) entry.fail("name may hold letters, digits, '-' and '_' only");
  if (finger.trajectory.empty() == finger.steps.empty()) entry.fail("needs either a trajectory or a script");
}

std::vector<KeyRow> describeFinger() {
  std::vector<KeyRow> rows = describe<Finger>("[[finger]]", fingerKeys());
  for (std::size_t move = 0; move < kMoveNames.size(); ++move) {
    const std::string title = fmt::format("script, do = \"{}\"", kMoveNames[move]);
    for (KeyRow& row : describe<Step>(title, stepKeys(static_cast<Move>(move)))) {
      if (row.key != "do") rows.push_back(std::move(row));
    }
  }
  return rows;
}

Section fingerSection() {
  const auto read = [](const toml::table& table, const Entry& entry) {
    Finger finger;
    readTable(table, entry.name, entry.file, fingerKeys(), finger);
    checkFinger(finger, entry);
    return finger;
  };
  return listSection<Finger>("finger", "Who touches it: any number of fingers, each on its own.", &Scene::fingers, read,
                             fingerKeys(), describeFinger);
}

}  // namespace

const std::vector<Key<Scene>>& topKeys() {
  using S = Scene;
  static const std::vector<Key<S>> keys = {
      text<S>("title", &S::title, "What the report calls the run."),
      fidelityKey(),
      number<S>("seconds", &S::seconds, between(0, 10800),
                "How long it runs; 0 is until the last finger has finished."),
      number<S>("ticks_per_s", &S::ticks_per_s, between(100, 10000), "Rate of the servo loop."),
  };
  return keys;
}

const std::vector<Section>& sections() {
  static const std::vector<Section> all = {
      bodySection(),    stiffnessSection(), dysfunctionSection(), ellipsesSection(),    frictionSection(),
      contactSection(), partitionSection(), tissueSection(),      deformationSection(), strainSection(),
      outputSection(),  viewSection(),      safetySection(),      fingerSection(),
  };
  return all;
}

}  // namespace palpate::scene
