// A muscle is a few guide fibres between landmarks, from one border to the other; the fibres between them come from
// Catmull and Rom's curves, and each of their points goes to the nearest skin, with which it then moves. Landmarks are
// on the skin, so a guide between two of them is never far below it.
#include "palpate/view/overlays/muscle_marks.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <string_view>

#include "palpate/tree/triangle_tree.h"
#include "palpate/view/overlays/marks.h"
#include "palpate/view/skin_place.h"

namespace palpate::view {

namespace {

constexpr std::array<std::string_view, 2> kBothSides = {"_left", "_right"};
constexpr int kFibres = 33;        // two borders and 32 stripes
constexpr int kSpotsInFibre = 41;  // 2 to 10 mm apart: skin curves less than lines are drawn above it

/// The places of one side by their names without it. Missing ones are noted, not thrown.
class SidePlaces {
 public:
  SidePlaces(std::span<const body::SkinLandmark> landmarks, std::string_view side) {
    for (const body::SkinLandmark& mark : landmarks) {
      std::string name = mark.name;
      if (const auto at = name.find(side); at != std::string::npos) name.erase(at, side.size());
      places_[name] = mark.position;
    }
  }

  Vec3 at(const std::string& name) {
    const auto found = places_.find(name);
    if (found != places_.end()) return found->second;
    complete_ = false;
    return Vec3::Zero();
  }
  /// A share of the way from one to the other; 1 is there.
  Vec3 between(const std::string& from, const std::string& to, double share) {
    return (1.0 - share) * at(from) + share * at(to);
  }
  /// Whether every requested place exists.
  bool complete() const { return complete_; }

 private:
  std::map<std::string, Vec3> places_;
  bool complete_ = true;
};

using GuideFibre = std::vector<Vec3>;
/// All have the same number of points.
using Guides = std::vector<GuideFibre>;

GuideFibre straight(const Vec3& from, const Vec3& to) { return {from, 0.5 * (from + to), to}; }

/// Bowed backwards, where a chord would run deep under the shoulder blade and the ribs, and then be nearer to the
/// armpit's skin than to the back's.
GuideFibre bowed(const Vec3& from, const Vec3& to) {
  GuideFibre fibre = {from, (2.0 * from + to) / 3.0, (from + 2.0 * to) / 3.0, to};
  const double behind = std::max(from.z(), to.z());
  fibre[1].z() = 0.95 * behind + 0.05 * std::min(from.z(), to.z());
  fibre[2].z() = 0.85 * behind + 0.15 * std::min(from.z(), to.z());
  return fibre;
}

/// From the spines of C5 to T12 (the neck ends at C5) to the outer third of the clavicle, the acromion and the spine of
/// the scapula, to whose root the lower fibres run together.
Guides trapezius(SidePlaces& side) {
  const Vec3 root = side.between("scapula_spine_root", "scapula_acromial_angle", 0.06);
  return {straight(side.at("spinous_C5"), side.between("clavicle_acromial_end", "clavicle_sternal_end", 0.25)),
          straight(side.at("spinous_C6"), side.at("clavicle_acromial_end")),
          straight(side.at("spinous_C7"), side.at("acromion")),
          straight(side.at("spinous_T2"), side.at("scapula_acromial_angle")),
          straight(side.at("spinous_T3"), side.between("scapula_spine_root", "scapula_acromial_angle", 0.5)),
          straight(side.at("spinous_T5"), root),
          straight(side.at("spinous_T8"), root),
          straight(side.at("spinous_T12"), root)};
}

/// From the spines of T7 to L5, the sacrum and the iliac crest, aponeurosis and all, over the lower angle of the
/// scapula to the hind fold of the armpit, where the skin over its tendon ends.
Guides latissimus(SidePlaces& side) {
  const Vec3 armpit = side.between("scapula_inferior_angle", "greater_tubercle", 0.55);
  const Vec3 below = side.between("scapula_inferior_angle", "greater_tubercle", 0.48);
  const Vec3 angle = side.between("scapula_inferior_angle", "scapula_spine_root", 0.1);
  const Vec3 crest = side.between("iliac_crest_top", "asis", 0.3);
  GuideFibre upper = bowed(side.at("spinous_T7"), armpit);  // lower than straight: over the angle of the scapula
  upper[1] = 0.6 * upper[1] + 0.4 * side.between("spinous_T7", "scapula_inferior_angle", 0.5);
  upper[2] = 0.6 * upper[2] + 0.4 * angle;
  return {upper,
          bowed(side.at("spinous_T10"), armpit),
          bowed(side.at("spinous_L1"), armpit),
          bowed(side.at("spinous_L4"), 0.5 * (armpit + below)),
          bowed(side.at("sacrum_S1"), 0.5 * (armpit + below)),
          bowed(side.at("psis"), below),
          bowed(side.at("iliac_crest_top"), below),
          bowed(crest, below)};
}

/// Along the spine from sacrum and iliac crest to the neck: spinalis along the spines, iliocostalis as far as the
/// angles of the ribs.
Guides erector(SidePlaces& side) {
  struct Level {
    const char* spine;
    const char* lateral;
    double share;  // share of the way to it that the muscle reaches
  };
  constexpr Level kLevels[] = {
      {"sacrum_S3", "psis", 0.3},          {"spinous_L5", "psis", 0.9},         {"spinous_L3", "iliac_crest_top", 0.62},
      {"spinous_L1", "rib_12_angle", 1.2}, {"spinous_T9", "rib_9_angle", 0.85}, {"spinous_T6", "rib_6_angle", 0.7},
      {"spinous_T3", "rib_3_angle", 0.65}, {"spinous_C7", "rib_2_angle", 0.45}};
  constexpr double kBesideSpine = 0.12;  // share of the muscle's width
  Guides guides(3);
  for (const Level& level : kLevels) {
    for (std::size_t i = 0; i < guides.size(); ++i) {
      const double across = kBesideSpine + (1.0 - kBesideSpine) * static_cast<double>(i) / 2.0;
      guides[i].push_back(side.between(level.spine, level.lateral, across * level.share));
    }
  }
  return guides;
}

/// Catmull and Rom's curve through the points; `share` 0 to 1.
Vec3 onCurve(std::span<const Vec3> points, double share) {
  const double last = static_cast<double>(points.size() - 1);
  const auto piece = static_cast<std::size_t>(std::min(share * last, last - 1.0));
  const double t = share * last - static_cast<double>(piece);
  const Vec3& b = points[piece];
  const Vec3& c = points[piece + 1];
  const Vec3 a = piece > 0 ? points[piece - 1] : Vec3(2.0 * b - c);
  const Vec3 d = piece + 2 < points.size() ? points[piece + 2] : Vec3(2.0 * c - b);
  return 0.5 *
         (2.0 * b + t * (c - a) + t * t * (2.0 * a - 5.0 * b + 4.0 * c - d) + t * t * t * (3.0 * b - a - 3.0 * c + d));
}

/// `across` from border to border, `along` the fibre, both 0 to 1.
Vec3 inSheet(const Guides& guides, double across, double along) {
  std::vector<Vec3> level;
  for (const GuideFibre& fibre : guides) level.push_back(onCurve(fibre, along));
  return onCurve(level, across);
}

SkinSpot spotNear(const scene::World& world, const Vec3& place) {
  const SkinPlace found = nearestOnSkin(world, place);
  const Triangle& t = world.body->skin.triangles[found.triangle];
  const std::array<Vec3, 3> corners = {world.body->skin.positions[t[0]], world.body->skin.positions[t[1]],
                                       world.body->skin.positions[t[2]]};
  return {t, tree::barycentricWeights(corners, found.point).cast<float>()};
}

struct MuscleKind {
  const char* name;
  Paint paint;
  Guides (*guides)(SidePlaces& side);
  double name_across, name_along;  ///< the point for its name
};
constexpr MuscleKind kMuscles[] = {
    {"erector spinae", kErectorPaint, erector, 0.6, 0.3},
    {"latissimus dorsi", kLatissimusPaint, latissimus, 0.7, 0.5},
    {"trapezius", kTrapeziusPaint, trapezius, 0.4, 0.5},
};

/// Collects the result of `use` for each muscle of each side; empty where a place is missing.
template <class Use>
void forMuscles(std::span<const body::SkinLandmark> landmarks, const Use& use) {
  if (!hasMuscles(landmarks)) return;
  for (const MuscleKind& kind : kMuscles) {
    for (const std::string_view name : kBothSides) {
      SidePlaces side(landmarks, name);
      use(kind, kind.guides(side));
    }
  }
}

}  // namespace

bool hasMuscles(std::span<const body::SkinLandmark> landmarks) {
  return std::ranges::all_of(kBothSides, [&](std::string_view name) {
    SidePlaces side(landmarks, name);
    for (const MuscleKind& kind : kMuscles) kind.guides(side);
    return side.complete();
  });
}

std::vector<MuscleSheet> muscleSheets(const scene::World& world) {
  std::vector<MuscleSheet> muscles;
  forMuscles(world.body->anatomy.landmarks, [&](const MuscleKind& kind, const Guides& guides) {
    MuscleSheet& muscle = muscles.emplace_back(MuscleSheet{kind.paint, {}});
    for (int i = 0; i < kFibres; ++i) {
      std::vector<SkinSpot>& fibre = muscle.fibres.emplace_back();
      for (int j = 0; j < kSpotsInFibre; ++j) {
        const double across = static_cast<double>(i) / (kFibres - 1);
        const double along = static_cast<double>(j) / (kSpotsInFibre - 1);
        fibre.push_back(spotNear(world, inSheet(guides, across, along)));
      }
    }
  });
  return muscles;
}

void addMuscle(const MuscleSheet& muscle, const DrawnSkin& skin, Patches& stripes, Lines& border) {
  constexpr std::array kStripes = {0.34, 0.52};  // opacity in turn: which way the fibres run
  std::vector<std::vector<Vec3>> at;
  for (const std::vector<SkinSpot>& fibre : muscle.fibres) {
    std::vector<Vec3>& line = at.emplace_back();
    for (const SkinSpot& spot : fibre) line.push_back(placeOf(spot, skin));
  }
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    const Paint paint = faded(muscle.paint, kStripes[i % kStripes.size()]);
    for (std::size_t j = 0; j + 1 < at[i].size(); ++j) {
      stripes.addQuad({at[i][j], at[i + 1][j], at[i + 1][j + 1], at[i][j + 1]}, paint);
    }
  }
  border.addPath(at.front(), muscle.paint);
  border.addPath(at.back(), muscle.paint);
  std::vector<Vec3> origin, insertion;
  for (const std::vector<Vec3>& line : at) {
    origin.push_back(line.front());
    insertion.push_back(line.back());
  }
  border.addPath(origin, muscle.paint);
  border.addPath(insertion, muscle.paint);
}

std::vector<BodyName> muscleNames(const scene::World& world) {
  std::vector<BodyName> names;
  forMuscles(world.body->anatomy.landmarks, [&](const MuscleKind& kind, const Guides& guides) {
    const Vec3 middle = inSheet(guides, kind.name_across, kind.name_along);
    names.push_back(nameAt(world, kind.name, NameKind::muscle, nearestOnSkin(world, middle)));
  });
  return names;
}

}  // namespace palpate::view
