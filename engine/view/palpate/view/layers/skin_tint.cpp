// Three octaves of value noise in rest coordinates for blood and for pigment, the depth to bone, and the curvature from
// the normals of neighbours become four bytes per vertex; folds are darker and redder (skyLeft).
#include "palpate/view/layers/skin_tint.h"

#include <algorithm>
#include <cmath>

#include "palpate/view/made_skin.h"

namespace palpate::view {

namespace {

/// Mottling: sizes of the blotches (mm), and how much all of them change the colour.
constexpr double kBlotchMm[] = {60.0, 30.0, 15.0};
constexpr double kBlotchShare[] = {0.5, 0.3, 0.2};
constexpr double kMottling = 0.08;
/// Bone shows through skin that is not much thicker than this.
constexpr double kThinSkinMm = 9.0;
/// The share of all light lost at a place without sky.
constexpr double kShade = 0.85;
/// The share lost in a crease.
constexpr double kCreaseShade = 0.42;
/// A sphere of this radius counts as fully curved: a fingertip.
constexpr double kFullCurvatureMm = 8.0;

double mottlingAt(const Vec3& p) {
  double sum = 0.0;
  for (std::size_t i = 0; i < std::size(kBlotchMm); ++i) sum += kBlotchShare[i] * noiseAt(p / kBlotchMm[i]);
  // The sum of smooth noises seldom comes near its bounds: spread it.
  return std::clamp(1.8 * sum, -1.0, 1.0);
}

/// 0 far from bone, 1 right over it; and the wider red halo of skin that is rubbed: spine and shoulder blades.
struct BoneInfluence {
  double thin = 0.0;
  double red = 0.0;
};

BoneInfluence boneInfluence(const scene::Anatomy& anatomy, Index vertex) {
  if (anatomy.depth_mm.empty()) return {};
  const double depth = anatomy.depth_mm[vertex];
  const bool rubbed = anatomy.bones[anatomy.nearest_bone[vertex]].kind != body::BoneKind::rib;
  constexpr double kRedReachMm = 22.0;
  return {std::exp(-(depth * depth) / (kThinSkinMm * kThinSkinMm)), rubbed ? std::exp(-depth / kRedReachMm) : 0.0};
}

double curvatureAt(const deform::Skin& skin, Index vertex) {
  double largest = 0.0;
  const Vec3f place = skin.restPosition(vertex);
  const Vec3f normal = skin.restNormal(vertex);
  for (const Index other : skin.neighbours[vertex]) {
    const double length = (skin.restPosition(other) - place).norm();
    if (length > 0.0) largest = std::max<double>(largest, (skin.restNormal(other) - normal).norm() / length);
  }
  return std::min(1.0, largest * kFullCurvatureMm);
}

/// Hollowness of the skin, 1/mm: half the mean bend towards the neighbours.
double hollowAt(const deform::Skin& skin, Index vertex) {
  double bend = 0.0;
  int count = 0;
  const Vec3f place = skin.restPosition(vertex);
  const Vec3f normal = skin.restNormal(vertex);
  for (const Index other : skin.neighbours[vertex]) {
    const Vec3f way = skin.restPosition(other) - place;
    if (!(way.squaredNorm() > 0.0f)) continue;
    bend += normal.dot(way) / way.squaredNorm();
    ++count;
  }
  return count > 0 ? bend / count : 0.0;
}

/// The share of light that is left in a crease, which is too narrow for the patches of skyLeft.
double leftInCrease(double hollow) { return 1.0 - kCreaseShade * std::clamp((hollow - 0.010) / 0.05, 0.0, 1.0); }

/// Pigment by sun, at its most on a back: neck and shoulders tanned, clothed parts paler. `up`: 0 at L4, 1 at T1.
double tanAt(double up) {
  const auto rise = [](double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
  };
  return 0.17 * rise(0.35, 1.1, up) - 0.09 * (1.0 - rise(-0.32, 0.02, up));
}

std::uint8_t toByte(double value) { return static_cast<std::uint8_t>(std::clamp(value + 0.5, 0.0, 255.0)); }

TintBytes tintAt(const scene::World& world, Index vertex, double open, double tan) {
  const Vec3 place = world.body->skin.positions[vertex] - world.deformable->origin;
  const BoneInfluence bone = boneInfluence(world.body->anatomy, vertex);
  // Blood varies more than pigment: the red channel least in value, so blotches read as warmer and cooler.
  const double blood = 0.6 * mottlingAt(place) + 1.1 * (bone.red - 0.35) * (bone.red > 0.0 ? 1.0 : 0.0);
  const double pigment = mottlingAt(place + Vec3(311.0, 173.0, 59.0));
  const double light = 1.0 + kMottling * 0.6 * pigment + 0.05 * bone.thin;
  const double red = light * (1.0 + 0.15 * kMottling * blood);
  const double green = light * (1.0 - kMottling * blood + 0.03 * bone.thin);
  const double blue = light * (1.0 - 0.8 * kMottling * blood + 0.05 * bone.thin);
  // Light reflected to and fro in a fold has become redder.
  const double shade = (1.0 - kShade * (1.0 - open)) * leftInCrease(hollowAt(*world.deformable, vertex));
  return {toByte(kTintUnit * red * std::pow(shade, 0.8) * std::exp(-0.60 * tan)),
          toByte(kTintUnit * green * std::pow(shade, 1.1) * std::exp(-0.95 * tan)),
          toByte(kTintUnit * blue * std::pow(shade, 1.2) * std::exp(-1.45 * tan)),
          toByte(255.0 * curvatureAt(*world.deformable, vertex))};
}

/// Heights of T1 and L4, between which the sun is computed: for a body that has them and no picture with a sun of its
/// own.
struct TannedSpan {
  double low = 0.0;
  double high = 0.0;
};

TannedSpan tannedSpan(const scene::World& world) {
  TannedSpan span;
  if (world.body->texture != nullptr) return span;
  for (const body::SkinLandmark& landmark : world.body->anatomy.landmarks) {
    if (landmark.name == "spinous_T1") span.high = landmark.position.y();
    if (landmark.name == "spinous_L4") span.low = landmark.position.y();
  }
  return span;
}

}  // namespace

std::vector<TintBytes> skinTints(const scene::World& world) {
  std::vector<TintBytes> tints(world.deformable->vertices);
  const std::vector<float> open = skyLeft(*world.deformable);
  const TannedSpan span = tannedSpan(world);
  const bool tanned = span.low < span.high;
  for (Index v = 0; v < world.deformable->vertices; ++v) {
    const double up = (world.body->skin.positions[v].y() - span.low) / (span.high - span.low);
    tints[v] = tintAt(world, v, open[v], tanned ? tanAt(up) : 0.0);
  }
  return tints;
}

}  // namespace palpate::view
