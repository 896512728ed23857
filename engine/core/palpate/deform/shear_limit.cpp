// The steps: room in a thin part, next to skin that stays and along the surface, seams of two fingers, folded
// triangles.
//
// Data flow: regions and amplitudes of the plan, displaced surface -> here, behind every displacement -> positions and
// displacements of the surface; which vertices were held back -> their normals. Costs about 0.1 us a vertex of a region
// with an edge, about 10 ns a triangle at a doubtful vertex, and nothing else.
// The projection after Mueller, Heidelberger, Hennix, Ratcliff, "Position based dynamics", 2007.
#include "palpate/deform/shear_limit.h"

#include <algorithm>
#include <cmath>

namespace palpate::deform {

namespace {

/// Shares of a triangle's area at rest, seen along its rest normal: below the first it counts as folded, and is raised
/// to the second, so that rounding does not fold it again.
constexpr double kFolded = 1e-3;
constexpr double kUnfolded = 0.03;
/// Factor on the share of its displacement that a triangle may keep: room for its neighbours. Without it one contact in
/// three hundred on scanned bodies did not come to an end.
constexpr double kReserve = 0.8;
/// Turns of drawing triangles together: on scanned bodies one to five, a hundred at most.
constexpr int kTurns = 200;
/// Turns along the vertices of fingers that press towards each other, of which each shortens what is too long: two to
/// ten on scanned hands.
constexpr int kSeamTurns = 50;
/// Triangles in one turn, two hundred times what scanned bodies need; more are not a matter of single triangles.
constexpr std::size_t kMaxFolds = 4096;
/// Most rounds of shortening everything. Each leaves at most nine tenths.
constexpr int kShortenings = 60;
/// A vertex is held back if it goes beyond its room by more than rounding.
constexpr float kBeyondRounding = 1.0f + 1e-5f;
/// Height of a triangle over its longest side, as a share of the largest coordinate, below which floats do not
/// distinguish one side of it from the other: sixteen roundings.
constexpr double kThinnest = 1e-6;

Vec3 vectorAt(const DeformedBlock& surface, int first, Index v) noexcept {
  return {surface.values[first][v], surface.values[first + 1][v], surface.values[first + 2][v]};
}

Vec3 displacementAt(const DeformedBlock& surface, Index v) noexcept { return vectorAt(surface, 6, v); }

/// The share of the least root of a + b s + c s^2 in (0, 1]; 1 without a root. `a` is positive.
double leastRoot(double a, double b, double c) noexcept {
  const double root2 = b * b - 4.0 * a * c;
  if (root2 < 0.0) return 1.0;
  // Both roots without cancellation.
  const double t = -0.5 * (b + std::copysign(std::sqrt(root2), b));
  double least = 1.0;
  if (t != 0.0 && a / t > 0.0) least = std::min(least, a / t);
  if (c != 0.0 && t / c > 0.0) least = std::min(least, t / c);
  return least;
}

}  // namespace

/// A triangle's area along its rest normal as its displacement grows by a share s: area + linear s + square s^2.
struct ShearLimit::Fold {
  double area = 0.0;  ///< squared, at rest
  double linear = 0.0;
  double square = 0.0;
  bool has_sides = false;  ///< false if it is too thin to fold, or has numbers that are not finite

  Fold(const Skin& skin, const Triangle& triangle, const DeformedBlock& surface) noexcept {
    Vec3 rest[3];
    Vec3 moved[3];
    for (std::size_t i = 0; i < 3; ++i) {
      rest[i] = skin.restPosition(triangle[i]).cast<double>();
      moved[i] = vectorAt(surface, 0, triangle[i]) - rest[i];
    }
    const Vec3 a = rest[1] - rest[0];
    const Vec3 b = rest[2] - rest[0];
    const Vec3 u = moved[1] - moved[0];
    const Vec3 v = moved[2] - moved[0];
    const Vec3 normal = a.cross(b);
    const double longest2 = std::max({a.squaredNorm(), b.squaredNorm(), (b - a).squaredNorm()});
    const double largest = std::max(
        {rest[0].lpNorm<Eigen::Infinity>(), rest[1].lpNorm<Eigen::Infinity>(), rest[2].lpNorm<Eigen::Infinity>()});
    area = normal.squaredNorm();
    has_sides = area > kThinnest * kThinnest * largest * largest * longest2;
    linear = (a.cross(v) + u.cross(b)).dot(normal);
    square = u.cross(v).dot(normal);
  }
  bool isFolded() const noexcept { return has_sides && area + linear + square < kFolded * area; }
  /// The largest share up to which it never folds.
  double share() const noexcept { return leastRoot(area * (1.0 - kUnfolded), linear, square); }
};

namespace {

/// A quick look in floats: true only if the triangle is not folded. Needles and triangles that lost most of their area
/// are left to Fold.
bool isCertainlyUnfolded(const Skin& skin, const Triangle& triangle, const DeformedBlock& surface) noexcept {
  constexpr float kPlainly = 0.05f;
  constexpr float kWide = 1e-4f;  // height over side: a thousand times what rounding makes of the area
  const auto position = [&](Index v) {
    return Vec3f(surface.values[0][v], surface.values[1][v], surface.values[2][v]);
  };
  const Vec3f corner = position(triangle[0]);
  const Vec3f first = position(triangle[1]) - corner;
  const Vec3f second = position(triangle[2]) - corner;
  const Vec3f rest_corner = skin.restPosition(triangle[0]);
  const Vec3f rest_first = skin.restPosition(triangle[1]) - rest_corner;
  const Vec3f rest_second = skin.restPosition(triangle[2]) - rest_corner;
  const float longest2 =
      std::max({first.squaredNorm(), second.squaredNorm(), rest_first.squaredNorm(), rest_second.squaredNorm()});
  const Vec3f normal = rest_first.cross(rest_second);
  const float area2 = normal.squaredNorm();
  return area2 > kWide * kWide * longest2 * longest2 && first.cross(second).dot(normal) > kPlainly * area2;
}

}  // namespace

ShearLimit::ShearLimit(const Skin& skin, std::size_t most_pulls)
    : skin_(skin),
      from_staying_(skin),
      from_anchor_(skin),
      regions_(skin.blocks, 0),
      region_(skin.blocks, 0),
      doubts_(skin.blocks, 0),
      room_(skin.vertices, 0.0f),
      is_pinning_(skin.blocks, 0),
      is_held_(skin.blocks, 0),
      is_listed_(blocksFor(static_cast<Index>(skin.triangles.size())), 0) {
  blocks_.reserve(skin.blocks);
  held_.reserve(skin.vertices);
  pinning_.reserve(skin.vertices);
  torn_.reserve(most_pulls);
  folds_.reserve(kMaxFolds);
  next_folds_.reserve(kMaxFolds);
}

void ShearLimit::start() noexcept {
  for (const Index v : held_) is_held_[blockOf(v)] = 0;
  held_.clear();
}

void ShearLimit::setPulls(std::span<const Pull> pulls) noexcept {
  pulls_ = pulls;
  for (const Index v : pinning_) is_pinning_[blockOf(v)] = 0;
  pinning_.clear();
  for (const Index block : blocks_) regions_[block] = 0;
  blocks_.clear();
  for (const Pull& pull : pulls) {
    for (const BlockPart& part : pull.region) {
      if (regions_[part.block] == 0 && part.vertices != 0) blocks_.push_back(part.block);
      regions_[part.block] |= part.vertices;
    }
  }
}

void ShearLimit::limitToPart(const DeformedBlock& surface) noexcept {
  forEachMoved([&](Index v) {
    const float room = kShareOfThickness * skin_.thickness_mm[v];
    const auto inwards = static_cast<float>(-displacementAt(surface, v).dot(skin_.restNormal(v).cast<double>()));
    if (inwards > room * kBeyondRounding) hold(v, room / inwards, surface);
  });
}

bool ShearLimit::hasOpposingPulls() const noexcept {
  for (const Pull& a : pulls_) {
    for (const Pull& b : pulls_) {
      if (a.normal.dot(b.normal) < 0.0) return true;
    }
  }
  return false;
}

/// Shortens what moves the ends of the vertex's edges apart. True if anything was.
bool ShearLimit::limitParting(Index vertex, const DeformedBlock& surface) noexcept {
  bool any = false;
  for (const Index beside : skin_.neighbours[vertex]) {
    const float room = kMaxParting * (skin_.restPosition(vertex) - skin_.restPosition(beside)).norm();
    const auto parts = static_cast<float>((displacementAt(surface, vertex) - displacementAt(surface, beside)).norm());
    if (!(parts > room * kBeyondRounding)) continue;
    hold(vertex, room / parts, surface);
    if (moves(beside)) hold(beside, room / parts, surface);
    any = true;
  }
  return any;
}

void ShearLimit::joinSeams(const DeformedBlock& surface) noexcept {
  if (pulls_.size() < 2 || !hasOpposingPulls()) return;
  for (int turn = 0; turn < kSeamTurns; ++turn) {
    bool any = false;
    forEachMoved([&](Index v) { any = limitParting(v, surface) || any; });
    if (!any) return;
  }
}

/// The distances from the anchor along the pull's region.
void ShearLimit::measureAlongSurface(const Pull& pull) noexcept {
  for (const BlockPart& part : pull.region) region_[part.block] = part.vertices;
  from_anchor_.start();
  for (const Index corner : skin_.triangles[pull.anchor_triangle]) {
    from_anchor_.seed(corner, static_cast<float>((skin_.restPosition(corner).cast<double>() - pull.anchor).norm()));
  }
  const double reach = kRoundabout * std::max(pull.press_reach_mm, pull.drag_reach_mm);
  from_anchor_.spread(skin_, static_cast<float>(reach), [&](Index v, float) { return isIn(v, region_); });
  for (const BlockPart& part : pull.region) region_[part.block] = 0;
}

/// Where skin stays it pins what is joined to it, unless that has room enough. Returns how far the farthest of those
/// moves, or of the walls.
double ShearLimit::seedAtEdges(const Pull& pull, double slope, const DeformedBlock& surface) noexcept {
  double farthest2 = 0.0;
  const auto squared_length = [&](Index v) { return displacementAt(surface, v).squaredNorm(); };
  for (const BlockPart& part : pull.edges) {
    const Index first = part.block * kBlockVertices;
    forEachBit(part.vertices & regions_[part.block],
               [&](Index bit) { farthest2 = std::max(farthest2, squared_length(first + bit)); });
    forEachBit(part.vertices & ~regions_[part.block], [&](Index bit) {
      const Index stays = first + bit;
      double beside2 = 0.0;
      for (const Index v : skin_.neighbours[stays]) {
        if (moves(v)) beside2 = std::max(beside2, squared_length(v));
      }
      farthest2 = std::max(farthest2, beside2);
      const double room = skin_.room_beside_staying[stays];
      if (beside2 > room * room) notePinning(stays);
      if (beside2 > room * room || !isGentle(slope)) seedBeside(stays);
    });
  }
  return std::sqrt(farthest2);
}

void ShearLimit::seedBeside(Index stays) noexcept {
  for (const Index v : skin_.neighbours[stays]) {
    if (moves(v)) from_staying_.seed(v, (skin_.restPosition(v) - skin_.restPosition(stays)).norm());
  }
}

/// From there on as long as it may matter. Skin less steep than kSteepest is held back farther on only through vertices
/// that are held back too; steeper skin is followed to where it moves by a quarter of its room.
void ShearLimit::taperBesideStaying(double most_mm, double slope, const DeformedBlock& surface) noexcept {
  const float matters = isGentle(slope) ? kSteepest : 0.25f * kSteepest;
  from_staying_.spread(skin_, static_cast<float>(most_mm / kSteepest),
                       [&](Index v, float mm) { return moves(v) && displacementAt(surface, v).norm() > matters * mm; });
}

void ShearLimit::holdWithin(Index vertex, float room_mm, const DeformedBlock& surface) noexcept {
  const auto far = static_cast<float>(displacementAt(surface, vertex).norm());
  if (far > room_mm * kBeyondRounding) hold(vertex, room_mm / far, surface);
}

void ShearLimit::noteHeld(Index vertex) noexcept {
  if (insertNew(vertex, is_held_)) held_.push_back(vertex);
}

void ShearLimit::notePinning(Index vertex) noexcept {
  if (insertNew(vertex, is_pinning_)) pinning_.push_back(vertex);
}

/// Leaves a vertex that share of its displacement.
void ShearLimit::hold(Index vertex, float share, const DeformedBlock& surface) noexcept {
  const Vec3f rest = skin_.restPosition(vertex);
  for (int axis = 0; axis < 3; ++axis) {
    float& displacement = surface.values[6 + axis][vertex];
    displacement *= share;
    surface.values[axis][vertex] = rest[axis] + displacement;
  }
  noteHeld(vertex);
}

void ShearLimit::unfold(const DeformedBlock& surface, std::span<const BlockPart> doubtful) noexcept {
  const bool is_few = findFolds(surface, doubtful);
  if (folds_.empty()) return;
  if (!is_few || !drawAllTogether(surface)) shorten(surface);
  for (const Index t : folds_) is_listed_[blockOf(t)] &= ~bitOf(t);
  folds_.clear();
}

/// Lists the folded triangles. False if not all fit.
bool ShearLimit::findFolds(const DeformedBlock& surface, std::span<const BlockPart> doubtful) noexcept {
  for (const BlockPart& part : doubtful) doubts_[part.block] = part.vertices & regions_[part.block];
  const auto is_looked_at = [&](Index v) { return isIn(v, doubts_); };
  for (const BlockPart& part : doubtful) {
    forEachBit(doubts_[part.block], [&](Index bit) {
      const Index v = part.block * kBlockVertices + bit;
      for (const Index t : skin_.triangles_of_vertex[v]) {
        // Once a triangle, at the first of its corners.
        const Triangle& corners = skin_.triangles[t];
        const auto is_before = [&](Index corner) { return corner < v && is_looked_at(corner); };
        if (std::any_of(corners.begin(), corners.end(), is_before) || isCertainlyUnfolded(skin_, corners, surface))
          continue;
        listIfFolded(t, surface);
      }
    });
  }
  for (const BlockPart& part : doubtful) doubts_[part.block] = 0;
  for (const Index v : pinning_) findFoldsAt(surface, v);
  for (const Index v : held_) findFoldsAt(surface, v);
  return folds_.size() < kMaxFolds;
}

void ShearLimit::findFoldsAt(const DeformedBlock& surface, Index vertex) noexcept {
  for (const Index t : skin_.triangles_of_vertex[vertex]) listIfFolded(t, surface);
}

void ShearLimit::listIfFolded(Index triangle, const DeformedBlock& surface) noexcept {
  if (folds_.size() < kMaxFolds && Fold(skin_, skin_.triangles[triangle], surface).isFolded()) listFold(triangle);
}

void ShearLimit::listFold(Index triangle) noexcept {
  if (insertNew(triangle, is_listed_)) folds_.push_back(triangle);
}

/// Triangle after triangle until none is folded. False if that does not come to an end.
bool ShearLimit::drawAllTogether(const DeformedBlock& surface) noexcept {
  for (int turn = 0; turn < kTurns && !folds_.empty(); ++turn) {
    std::swap(folds_, next_folds_);
    folds_.clear();
    for (const Index t : next_folds_) is_listed_[blockOf(t)] &= ~bitOf(t);
    for (const Index t : next_folds_) {
      if (Fold(skin_, skin_.triangles[t], surface).isFolded()) drawTogether(t, surface);
    }
    for (const Index t : next_folds_) {
      for (const Index corner : skin_.triangles[t]) {
        for (const Index beside : skin_.triangles_of_vertex[corner]) {
          if (folds_.size() == kMaxFolds) return false;
          if (Fold(skin_, skin_.triangles[beside], surface).isFolded()) listFold(beside);
        }
      }
    }
  }
  return folds_.empty();
}

/// Shortens what moves the corners apart; towards their mean, or to rest where one of them stays.
void ShearLimit::drawTogether(Index triangle, const DeformedBlock& surface) noexcept {
  const Triangle& corners = skin_.triangles[triangle];
  const double share = kReserve * Fold(skin_, corners, surface).share();
  Vec3 mean = Vec3::Zero();
  for (const Index v : corners) mean += displacementAt(surface, v) / 3.0;
  if (!std::all_of(corners.begin(), corners.end(), [&](Index v) { return moves(v); })) mean.setZero();
  for (const Index v : corners) {
    if (!moves(v)) continue;
    const Vec3f displacement = (mean + share * (displacementAt(surface, v) - mean)).cast<float>();
    const Vec3f place = skin_.restPosition(v) + displacement;
    for (int axis = 0; axis < 3; ++axis) {
      surface.values[6 + axis][v] = displacement[axis];
      surface.values[axis][v] = place[axis];
    }
    noteHeld(v);
  }
}

/// The last resort: everything that moves moves less.
void ShearLimit::shorten(const DeformedBlock& surface) noexcept {
  for (int i = 0; i < kShortenings; ++i) {
    const float share = shareWithoutFolds(surface);
    if (share == 1.0f) return;
    forEachMoved([&](Index v) { hold(v, share, surface); });
  }
  forEachMoved([&](Index v) { hold(v, 0.0f, surface); });
}

/// 1 if nothing is folded.
float ShearLimit::shareWithoutFolds(const DeformedBlock& surface) const noexcept {
  double share = 1.0;
  forEachMoved([&](Index v) {
    for (const Index t : skin_.triangles_of_vertex[v]) {
      const Fold fold(skin_, skin_.triangles[t], surface);
      if (fold.isFolded()) share = std::min({share, 0.9, fold.share()});
    }
  });
  return static_cast<float>(share);
}

}  // namespace palpate::deform
