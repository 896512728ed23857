// The tables [body], [stiffness], [[dysfunction]] and [ellipses] of a scene file: the touched body, and how hard and
// how far its skin follows.
#include <fmt/format.h>

#include "palpate/body/outline_mesher.h"
#include "palpate/body/torso.h"
#include "palpate/scene/detail/scene_keys.h"
#include "palpate/scene/words.h"

namespace palpate::scene {

namespace {

/// Remembers the line: faults of the picture are found when the body is built.
Key<BodySettings> textureKey() {
  using S = BodySettings;
  Key<S> key = file<S>("texture", way(&S::texture, &TextureSource::file),
                       "A PNG or JPEG picture on the skin, or a glTF or GLB file for its base colour picture. Mesh: "
                       "placed by the file's texture coordinates (OBJ, glTF, GLB). Trunk, torso, back: left half from "
                       "behind, right half from the front (docs/explanation/bodies.md), or \"made\" or \"made:SEED\" "
                       "for a generated skin (docs/explanation/rendering.md).");
  key.read = [read = std::move(key.read)](S& s, const Entry& entry) {
    read(s, entry);
    s.texture.scene_file = entry.file;
    s.texture.line = entry.line();
  };
  return key;
}

std::size_t fewestTriangles(BodyKind kind) {
  if (kind == BodyKind::trunk) return body::kFewestTrunkTriangles;
  return kind == BodyKind::back ? body::kFewestTriangles : body::kFewestTorsoTriangles;
}

/// Checks the kind and triangles of a built-in body.
void requireTriangles(const BodySettings& body, const Entry& entry) {
  if (body.kind == BodyKind::mesh || body.triangles == 0) return;
  const bool trunk = body.kind == BodyKind::trunk;
  const std::size_t least = fewestTriangles(body.kind);
  if (body.triangles < least) entry.fail(fmt::format("needs at least {} triangles", least));
  if (trunk && body.triangles % 2 != 0) {
    entry.fail(fmt::format("triangles must be even for a closed body: {} or {}, or set kind = \"torso\"",
                           body.triangles - 1, body.triangles + 1));
  }
}

}  // namespace

Section bodySection() {
  using S = BodySettings;
  using Shape = body::TrunkShape;
  std::vector<Key<S>> keys = {
      choice<S, BodyKind>("kind", &S::kind,
                          "The built-in trunk, only its back (torso), the dissertation's 350 x 400 x 120 mm piece of "
                          "that back (back), or a mesh file."),
      count<S>("triangles", &S::triangles, 0, 4'000'000,
               "Trunk, torso: number of skin and bone triangles; 0 means 83164 (trunk; must be even) or 20389 (torso). "
               "Back: number of skin triangles; 0 means 2962."),
      number<S>("stature_mm", way(&S::shape, &Shape::stature_mm), between(500, 2500),
                "Trunk, torso, back: height of the whole person."),
      number<S>("girth", way(&S::shape, &Shape::girth), between(0.8, 1.3),
                "Trunk: factor for the width and depth of the frame, including bones."),
      number<S>("body_mass_index", way(&S::shape, &Shape::body_mass_index), between(16, 45),
                "Trunk: body mass index (kg/m2), which sets the fat under the skin."),
      number<S>("muscle", way(&S::shape, &Shape::muscle), between(0, 2),
                "Trunk: muscle mass, from 0 (wasted) to 2 (athletic)."),
      number<S>("kyphosis_deg", way(&S::shape, &Shape::kyphosis_deg), between(15, 65),
                "Trunk: curvature of the thoracic spine, T1 to T12."),
      number<S>("lordosis_deg", way(&S::shape, &Shape::lordosis_deg), between(0, 50),
                "Trunk: curvature of the lumbar spine, L1 to L5."),
      choice<S, body::Posture>("posture", way(&S::shape, &Shape::posture),
                               "Trunk: standing, prone on a table (chest and belly pressed flat), or sitting."),
      number<S>("spine_relief", way(&S::shape, &Shape::relief, &body::ReliefSettings::spine), between(0, 3),
                "Trunk, torso, back: how clearly the spinous processes show on the skin; 0 is not at all, 1 is a lean "
                "man standing."),
      number<S>("rib_relief", way(&S::shape, &Shape::relief, &body::ReliefSettings::ribs), between(0, 3),
                "Trunk, torso, back: the same for the ribs."),
      number<S>("scapula_relief", way(&S::shape, &Shape::relief, &body::ReliefSettings::scapulae), between(0, 3),
                "Trunk, torso, back: the same for the shoulder blades."),
      number<S>("asymmetry", way(&S::shape, &Shape::asymmetry), between(0, 3),
                "Trunk, torso, back: natural differences between left and right; 0 is perfectly symmetric."),
      file<S>("file", &S::file,
              "Mesh: OBJ, STL, PLY, OFF, glTF or GLB, relative to the scene file; or \"made:scan\", a generated scan "
              "of a back with a hole."),
      choice<S, Unit>("unit", &S::unit, "Mesh: unit of the file; auto is m for glTF and GLB, otherwise mm."),
      number<S>("scale", &S::scale, above(0, 1e6), "Mesh: scale factor, applied after the unit."),
      text<S>("group", &S::group, "Mesh: only this group or object of an OBJ file."),
      flag<S>("repair", &S::repair,
              "Mesh: repair the mesh where possible; false rejects a mesh that is not fit for contact."),
      textureKey(),
      file<S>("fit", &S::fit,
              "Mesh: fit file written by palpate body fit for this scan; adds bones, names and stiffness by depth "
              "(docs/howto/fit-body.md)."),
  };
  return section<S>("body", "The body that is touched.", &Scene::body, std::move(keys),
                    [](const S& body, const Entry& entry) {
                      if (body.kind == BodyKind::mesh && body.file.empty())
                        entry.fail("of kind \"mesh\" requires a file");
                      if (body.kind != BodyKind::mesh && !body.file.empty())
                        entry.fail("has a file but is not of kind \"mesh\"");
                      if (body.kind != BodyKind::mesh && !body.fit.empty())
                        entry.fail("has a fit but is not of kind \"mesh\"");
                      requireTriangles(body, entry);
                    });
}

Section breathingSection() {
  using S = body::Breathing;
  std::vector<Key<S>> keys = {
      flag<S>("on", &S::on, "Trunk, torso, fitted mesh: the skin moves with breathing, visibly and to the touch."),
      number<S>("depth_mm", &S::depth_mm, between(0, 10),
                "How far the skin over the lower ribs moves between exhaling and inhaling."),
      number<S>("per_minute", &S::per_minute, above(0, 60), "Breaths per minute; 12 to 16 at rest."),
  };
  return section<S>("breathing", "How the body breathes (docs/explanation/bodies.md).", &Scene::breathing,
                    std::move(keys));
}

Section stiffnessSection() {
  using S = StiffnessSettings;
  std::vector<Key<S>> keys = {
      choice<S, StiffnessSource>("source", &S::source,
                                 "Stiffness from the depth of the bones, from key points, or constant; auto is depth "
                                 "on a built-in body or fitted mesh, constant on any other mesh."),
      number<S>("constant_n_per_mm", &S::constant_n_per_mm, above(0, 100),
                "Source \"constant\": the stiffness everywhere."),
      number<S>("soft_n_per_mm", way(&S::depth, &maps::DepthLaw::soft_n_per_mm), above(0, 100),
                "Source \"depth\": stiffness far from any bone."),
      number<S>("stiff_n_per_mm", way(&S::depth, &maps::DepthLaw::stiff_n_per_mm), above(0, 100),
                "Source \"depth\": stiffness where bone is just under the skin."),
      number<S>("fade_mm", way(&S::depth, &maps::DepthLaw::fade_mm), above(0, 1000),
                "Source \"depth\": depth over which the difference falls to 37 %."),
      number<S>("basic_n_per_mm", way(&S::points, &maps::MeasuredStiffness::basic_n_per_mm), above(0, 100),
                "Source \"points\": stiffness beyond the reach of any key point."),
      number<S>("effect_radius_mm", way(&S::points, &maps::MeasuredStiffness::effect_radius_mm), above(0, kLongestMm),
                "Source \"points\": radius of influence of a key point."),
      choice<S, maps::StiffnessInterpolation>("interpolation", way(&S::points, &maps::MeasuredStiffness::interpolation),
                                              "Source \"points\": exact at every point without overshoot; exact and as "
                                              "smooth as possible; or a smooth trend."),
      count<S>("polynomial_degree", way(&S::points, &maps::MeasuredStiffness::polynomial_degree), 0,
               maps::kMaxPolynomialDegree,
               "Source \"points\", interpolation \"polynomial\": degree of the polynomial."),
      number<S>("variation", way(&S::variation, &maps::NaturalVariation::variation), between(0, maps::kMaxVariation),
                "Natural variation across the body: standard deviation divided by the mean (docs/explanation/maps.md); "
                "0 is none, 0.15 is mild."),
      number<S>("variation_mm", way(&S::variation, &maps::NaturalVariation::length_mm), between(2, 1000),
                "Natural variation: distance over which the correlation falls to 37 %."),
      count<S, std::uint32_t>(
          "variation_seed", way(&S::variation, &maps::NaturalVariation::seed), 0, 4'000'000'000,
          "Natural variation: random seed; the same seed gives the same variation on every machine and mesh."),
  };
  return section<S>("stiffness", "How hard the body pushes back, in N per mm of depth.", &Scene::stiffness,
                    std::move(keys));
}

Section dysfunctionSection() {
  using S = maps::Dysfunction;
  const std::vector<Key<S>> keys = {
      text<S>("at", &S::at, "Centre by name: \"T9 right 30 mm\" (docs/reference/names.md)."),
      unlessNamed(
          number<S>("x_mm", &S::x_mm, between(-kLongestMm, kLongestMm), "Centre in coordinates, seen along z.")),
      unlessNamed(
          number<S>("y_mm", &S::y_mm, between(-kLongestMm, kLongestMm), "Centre in coordinates, seen along z.")),
      number<S>("radius_mm", &S::radius_mm, above(0, kLongestMm), "Nothing changes outside this radius."),
      number<S>("change_percent", &S::change_percent, between(-100, 10000), "Change of the stiffness at the centre."),
      number<S>("edge_softness", &S::edge_softness, between(0, 1),
                "Fraction of the radius over which the change fades out; 0 is a hard edge."),
  };
  const auto read = [keys](const TomlNode& table, const Entry& entry) {
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
              "Table of measured ellipses (docs/reference/maps.md; default: the dissertation's means on a built-in "
              "body, none on a mesh)."),
      choice<S, maps::ForceDirection>("data", way(&S::measured, &maps::MeasuredDataChoice::force),
                                      "Without key points: the dissertation's means for skin dragged up, or down."),
      choice<S, maps::Averaging>("averaging", way(&S::measured, &maps::MeasuredDataChoice::averaging),
                                 "Without key points: mean of the printed numbers, or of the ellipses themselves."),
      number<S>("effect_radius_mm", way(&S::map, &maps::EllipseMapSettings::effect_radius_mm), above(0, kLongestMm),
                "Radius of influence of a key point."),
      number<S>("basic_radius_mm", &S::basic_radius_mm, between(0, kLongestMm),
                "Radius of the circle beyond the reach of any key point; 0 means 150 mm on a built-in body, on a mesh "
                "at most 15 % of its diagonal."),
      choice<S, EllipsePlace>(
          "place", &S::place,
          "Where the map is sampled: at the friction anchor, or at the nearest vertex, as printed (5.2)."),
  };
  return section<S>("ellipses", "How far the skin follows a dragging finger.", &Scene::ellipses, std::move(keys));
}

}  // namespace palpate::scene
