// The tables [body], [stiffness], [[dysfunction]] and [ellipses] of a scene file: what is touched, and how hard and
// how far its skin follows.
#include "palpate/scene/section_keys.h"
#include "palpate/scene/words.h"

namespace palpate::scene {

namespace {

/// Remembers where it stands: what is wrong with the picture is found when the body is built.
Key<BodySettings> textureKey() {
  using S = BodySettings;
  Key<S> key = file<S>(
      "texture", way(&S::texture, &TextureSource::file),
      "Mesh: a PNG or JPEG picture that lies on the skin by the file's texture coordinates (OBJ, glTF, GLB); or a glTF "
      "or GLB file, for its base colour picture.");
  key.read = [read = std::move(key.read)](S& s, const Entry& entry) {
    read(s, entry);
    s.texture.scene_file = entry.file;
    s.texture.line = entry.line();
  };
  return key;
}

}  // namespace

Section bodySection() {
  using S = BodySettings;
  std::vector<Key<S>> keys = {
      choice<S, BodyKind>("kind", &S::kind, "The built-in torso with its bones, or a mesh file."),
      count<S>("triangles", way(&S::torso, &body::TorsoSettings::triangles), 5000, 4'000'000,
               "Torso: of skin and bones together; 8163, 20389 and 41582 are the dissertation's sizes."),
      number<S>("stature_mm", way(&S::torso, &body::TorsoSettings::shape, &body::SkinSettings::stature_mm),
                between(500, 2500), "Torso: how tall the whole person is."),
      number<S>("spine_relief",
                way(&S::torso, &body::TorsoSettings::shape, &body::SkinSettings::relief, &body::ReliefSettings::spine),
                between(0, 3),
                "Torso: how far the spinous processes show on the skin; 0 is not at all, 1 a lean standing man."),
      number<S>("rib_relief",
                way(&S::torso, &body::TorsoSettings::shape, &body::SkinSettings::relief, &body::ReliefSettings::ribs),
                between(0, 3), "Torso: the same for the ribs."),
      number<S>(
          "scapula_relief",
          way(&S::torso, &body::TorsoSettings::shape, &body::SkinSettings::relief, &body::ReliefSettings::scapulae),
          between(0, 3), "Torso: the same for the shoulder blades."),
      number<S>("asymmetry", way(&S::torso, &body::TorsoSettings::shape, &body::SkinSettings::asymmetry), between(0, 3),
                "Torso: natural differences of left and right; 0 is a mirror image."),
      file<S>("file", &S::file, "Mesh: OBJ, STL, PLY, OFF, glTF or GLB, relative to the scene file."),
      choice<S, Unit>("unit", &S::unit, "Mesh: the unit of the file; auto is m for glTF and GLB, mm for the others."),
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
          "source", &S::source,
          "Depth of the bones, key points with a stiffness, or the same everywhere; auto is depth "
          "on the torso and constant on a mesh."),
      number<S>("constant_n_per_mm", &S::constant_n_per_mm, above(0, 100), "The stiffness for source \"constant\"."),
      number<S>("soft_n_per_mm", way(&S::depth, &maps::DepthLaw::soft_n_per_mm), above(0, 100),
                "Source \"depth\": far from any bone."),
      number<S>("stiff_n_per_mm", way(&S::depth, &maps::DepthLaw::stiff_n_per_mm), above(0, 100),
                "Source \"depth\": where bone lies right under the skin."),
      number<S>("fade_mm", way(&S::depth, &maps::DepthLaw::fade_mm), above(0, 1000),
                "Source \"depth\": over this depth the difference falls to 37 %."),
      number<S>("basic_n_per_mm", way(&S::points, &maps::MeasuredStiffness::basic_n_per_mm), above(0, 100),
                "Source \"points\": where no key point reaches."),
      number<S>("effect_radius_mm", way(&S::points, &maps::MeasuredStiffness::effect_radius_mm), above(0, kLongestMm),
                "Source \"points\": how far a key point reaches."),
      choice<S, maps::StiffnessInterpolation>(
          "interpolation", way(&S::points, &maps::MeasuredStiffness::interpolation),
          "Source \"points\": through every point and never beyond them; through every point and smoothest; or the "
          "trend."),
      count<S>("polynomial_degree", way(&S::points, &maps::MeasuredStiffness::polynomial_degree), 0,
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
      choice<S, maps::ForceDirection>("data", way(&S::measured, &maps::MeasuredDataChoice::force),
                                      "Without key points: the dissertation's means of the skin dragged up, or down."),
      choice<S, maps::Averaging>("averaging", way(&S::measured, &maps::MeasuredDataChoice::averaging),
                                 "Without key points: means of the numbers as printed, or of the ellipses."),
      number<S>("effect_radius_mm", way(&S::map, &maps::EllipseMapSettings::effect_radius_mm), above(0, kLongestMm),
                "How far a key point reaches."),
      number<S>("basic_radius_mm", &S::basic_radius_mm, between(0, kLongestMm),
                "Radius of the circle where no key point reaches; 0 is 150 mm on the torso and at most 15 % of its "
                "diagonal on a mesh."),
      choice<S, EllipsePlace>("place", &S::place,
                              "Where the map is asked: at the friction anchor, or at the nearest vertex, as printed "
                              "(5.2)."),
  };
  return section<S>("ellipses", "How far the skin follows a dragging finger.", &Scene::ellipses, std::move(keys));
}

}  // namespace palpate::scene
