// The table [[lump]] of a scene file: a lump under the skin. Where it may lie is known when the body is built
// (scene/lumps_of_body.h).
#include "palpate/contact/lump_force.h"
#include "palpate/scene/detail/scene_keys.h"

namespace palpate::scene {

namespace {

using S = LumpSettings;

constexpr Range kDiameters = between(2, 40);
constexpr Range kHalfAxes = between(1, 20);
constexpr Range kRatios = between(0.2, 1000);
constexpr Range kYoungKpa = between(0.1, 1e6);

Key<S> halfAxesKey() {
  const auto read = [](S& lump, const Entry& entry) {
    const Vec3 half = readPoint3(entry, kHalfAxes);
    if (half.x() != half.y()) entry.fail("must begin with two equal numbers (a lump is round seen from above)");
    lump.half_axes_mm = half;
  };
  const auto show = [](const S& lump) {
    return lump.half_axes_mm ? showNumbers({lump.half_axes_mm->x(), lump.half_axes_mm->y(), lump.half_axes_mm->z()})
                             : std::string();
  };
  return {"half_axes_mm", "three numbers" + rangeSuffix(kHalfAxes),
          "Half axes of a flat or a long lump, in place of the diameter: across, across (equal), into the body.", read,
          show};
}

Key<S> youngKey() {
  return {"young_kpa",
          "number" + rangeSuffix(kYoungKpa),
          "Young's modulus, in place of stiffness_ratio.",
          [](S& lump, const Entry& entry) { lump.young_kpa = readNumber(entry, kYoungKpa); },
          [](const S& lump) { return lump.young_kpa > 0.0 ? showNumber(lump.young_kpa) : std::string(); },
          {KeyForm::Kind::number, kYoungKpa.low, kYoungKpa.high}};
}

Key<S> mobilityKey() {
  constexpr Range kMobilities = between(0.1, 100);
  const auto read = [=](S& lump, const Entry& entry) {
    const double value = readNumber(entry, atLeast(0));
    if (value != 0.0 && !kMobilities.holds(value)) {
      entry.fail("= " + outOfRange(fmt::format("{}", value), kMobilities) + ", or 0");
    }
    lump.mobility_mm_per_n = value;
  };
  return {"mobility_mm_per_n",
          "number" + rangeSuffix(kMobilities) + ", or 0",
          "Sideways motion under 1 N; 0 is fixed.",
          read,
          [](const S& lump) { return showNumber(lump.mobility_mm_per_n); },
          {KeyForm::Kind::number, 0.0, kMobilities.high}};
}

/// A number that another key takes the place of is not written.
Key<S> unless(Key<S> key, std::function<bool(const S&)> replaced) {
  key.show = [show = std::move(key.show), replaced = std::move(replaced)](const S& lump) {
    return replaced(lump) ? std::string() : show(lump);
  };
  return key;
}

std::vector<Key<S>> lumpKeys() {
  const Range place = between(-kLongestMm, kLongestMm);
  return {
      text<S>("name", &S::name, "Unique name (default: lump1, lump2, ...)."),
      text<S>("at", &S::at,
              "Place on the skin above its centre, by name: \"T9 right 30 mm\" (docs/reference/names.md)."),
      unlessNamed(number<S>("x_mm", &S::x_mm, place, "The same place in coordinates, seen along z.")),
      unlessNamed(number<S>("y_mm", &S::y_mm, place, "The same place in coordinates, seen along z.")),
      number<S>("depth_mm", &S::depth_mm, above(0, 1000),
                "Depth of its top below the skin at rest, along the normal; at least 0.5 mm below the skin layer."),
      unless(number<S>("diameter_mm", &S::diameter_mm, kDiameters, "Diameter of a spherical lump."),
             [](const S& lump) { return lump.half_axes_mm.has_value(); }),
      halfAxesKey(),
      unless(
          number<S>(
              "stiffness_ratio", &S::stiffness_ratio, kRatios,
              "Young's modulus divided by that of the layer at its centre; below 1 is a softer lump, such as a cyst."),
          [](const S& lump) { return lump.young_kpa > 0.0; }),
      youngKey(),
      number<S>("edge", &S::edge, between(0, 1),
                "Fraction of the radius over which its modulus falls smoothly to the tissue's; 0 is a sharp edge."),
      mobilityKey(),
      number<S>("mobility_limit_mm", &S::mobility_limit_mm, above(0, 100),
                "Maximum distance that it moves from its place."),
      number<S>("raise_mm", &S::raise_mm, between(0, 10),
                "Swelling at rest: height to which the skin above it is raised, as a smooth cap."),
  };
}

/// Two keys of which one takes the place of the other.
void requireAtMostOne(const TomlNode& table, const Entry& entry, const char* one, const char* other) {
  const TomlNode* first = table.get(one);
  const TomlNode* second = table.get(other);
  if (first == nullptr || second == nullptr) return;
  const std::size_t line = std::max(first->line(), second->line());
  throw Error::atLine(entry.file, line, fmt::format("{} takes {} or {}, not both", entry.name, one, other));
}

}  // namespace

Section lumpSection() {
  const auto read = [](const TomlNode& table, const Entry& entry) {
    S lump;
    lump.scene_file = entry.file;
    lump.line = entry.line();
    requireAtMostOne(table, entry, "stiffness_ratio", "young_kpa");
    requireAtMostOne(table, entry, "diameter_mm", "half_axes_mm");
    readTable(table, entry.name, entry.file, lumpKeys(), lump);
    if (const TomlNode* depth = table.get("depth_mm")) lump.depth_line = depth->line();
    return lump;
  };
  return listSection<S>(
      "lump",
      "A lump under the skin: a node, a cyst, a hard band. Requires layered tissue (docs/explanation/lumps.md).",
      &Scene::lumps, read, lumpKeys(), [] { return describe<S>("[[lump]]", lumpKeys()); });
}

}  // namespace palpate::scene
