// Holds the displaced skin back where it would tear or fold.
//
// The formulae of a press and a drag know the place of a vertex, not the surface: next to skin that stays behind
// because it faces away (between toes, at the rim of a narrow limb) a vertex may be moved farther than its triangle is
// long, and in a steep or thin triangle neighbours may be moved past each other. Five steps, each of which leaves alone
// what needs no help, bit by bit:
//   0. where the part is thin (Skin::thickness_mm) a vertex goes in by at most kShareOfThickness of it;
//   1. next to skin that stays behind, a vertex moves by at most kSteepest mm per mm of surface between the two;
//   2. a region that has such an edge, or a wall, ends along the surface too: a contact's motion falls off with the
//      way along the edges as in the profile stretched by kRoundabout, so that points near only through the air stay;
//   3. between fingers that press towards each other neighbours part by at most kMaxParting mm per mm between them;
//   4. triangles that may fold are looked at, and where one does its corners are drawn together just enough; if that
//      does not end, the whole displacement is shortened until none folds.
// 0 to 2 change steadily with the contact and do not depend on the order of vertices; 4 is exact. Costs nothing where
// no region has an edge and no block may fold (fold_bounds.h). The projection of single triangles after Mueller et
// al., "Position based dynamics", 2007.
#pragma once

#include <algorithm>
#include <bit>
#include <span>
#include <vector>

#include "palpate/deform/edge_distances.h"
#include "palpate/deform/skin.h"

namespace palpate::deform {

/// Motion by one contact, as far as its skin can be held back.
struct Pull {
  Vec3 anchor = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();
  Index anchor_triangle = kNoIndex;
  std::size_t contact = 0;  ///< index among those that the displacement has framed
  std::span<const BlockPart> region;
  /// Vertices next to the region that lie within its ellipses and yet stay, those in it that are steep, and some more;
  /// without those that do not matter by negligibleEdgeMotion.
  std::span<const BlockPart> edges;
  double press_mm = 0.0;        ///< motion of its centre, not below 0
  double drag_mm = 0.0;         ///< likewise
  double press_reach_mm = 1.0;  ///< half major axis
  double drag_reach_mm = 1.0;
};

class ShearLimit {
 public:
  ShearLimit(const Skin& skin, std::size_t most_pulls);

  /// Motion of the skin at an edge of a contact's region for which none of the three steps is needed, in addition to
  /// the room next to skin that stays (roomBesideStaying); `own_mm` is the motion of the contact's centre. 0 where that
  /// is not certain.
  static double negligibleEdgeMotion(double slope, double own_mm) noexcept {
    return isGentle(slope) ? kCertain * kFaint * own_mm : 0.0;
  }

  /// Step 0. Limits vertices that are deeper than the part allows to that depth.
  void limitToPart(const DeformedBlock& surface) noexcept;
  /// Whether that may hold anything back in a block that moves by at most this much. Only of a skin whose thickness is
  /// known.
  static bool isThin(const Skin& skin, Index block, double moved_mm) noexcept {
    return kShareOfThickness * skin.least_thickness_mm[block] < moved_mm;
  }

  /// Steps 1 and 2. `curves.press(pull, q)` and `curves.drag(pull, q)` are those that the displacement was made with,
  /// `curves.moved(pull, vertex)` is the largest motion of a vertex by a pull alone, mm; `slope` is how much the
  /// displacement differs per mm at most.
  template <class Curves>
  void taper(const DeformedBlock& surface, double slope, const Curves& curves) noexcept;

  /// Step 3. Nothing for one pull, and for pulls whose normals are less than a right angle apart.
  void joinSeams(const DeformedBlock& surface) noexcept;

  /// Step 4, for the triangles at moved vertices that are `doubtful`, at vertices held back and at skin that stays.
  void unfold(const DeformedBlock& surface, std::span<const BlockPart> doubtful) noexcept;

  /// Vertices that were held back since `start`, in no particular order.
  std::span<const Index> held() const noexcept { return held_; }
  /// Forgets them.
  void start() noexcept;
  /// The contacts that taper and unfold are about; their spans must stay.
  void setPulls(std::span<const Pull> pulls) noexcept;
  /// True if one of the pulls moves it.
  bool moves(Index vertex) const noexcept { return isIn(vertex, regions_); }

  /// Largest motion of a vertex per mm of surface between it and skin that stays. Below 0.7 a wall of right-angled
  /// triangles cannot turn over; half of that again is room for the widest angles of scanned skin.
  static constexpr float kSteepest = 0.6f;
  /// Largest parting of an edge's ends per mm of it, at a seam of two fingers: one finger alone makes 1.3 at most.
  static constexpr float kMaxParting = 2.0f;
  /// Share of the thickness under a vertex by which a part can be dented: as for the tissue over a bone.
  static constexpr float kShareOfThickness = 0.9f;

 private:
  /// On a sphere the way along the surface is at most pi/2 times that seen along the normal, and the way along edges at
  /// most sqrt(2) times that: round skin is never cut short.
  static constexpr double kRoundabout = 2.25;
  /// Shares of a contact's motion. Where at most the first arrives at every edge of its region (the flanks of a trunk),
  /// the skin behind them moves little anyway and is not measured; from the second on the measure counts in full.
  static constexpr double kFaint = 0.2;
  static constexpr double kPlain = 0.4;

  /// Share of a bound that counts; room for the rounding of floats.
  static constexpr double kCertain = 0.99;
  static constexpr double kRoundingMm = 1e-4;

  /// True if skin far from skin that stays is held only behind held skin next to it.
  static bool isGentle(double slope) noexcept { return slope < kSteepest; }

  struct Fold;
  /// A pull whose region has an edge worth measuring, and how much the measure counts.
  struct Torn {
    const Pull* pull;
    double share;
  };
  static double shareMeasured(double at_edge) noexcept {
    return std::clamp((at_edge - kFaint) / (kPlain - kFaint), 0.0, 1.0);
  }

  double seedAtEdges(const Pull& pull, double slope, const DeformedBlock& surface) noexcept;
  void seedBeside(Index stays) noexcept;
  void taperBesideStaying(double most_mm, double slope, const DeformedBlock& surface) noexcept;
  void measureAlongSurface(const Pull& pull) noexcept;
  template <class Curves>
  void roomAlongSurface(const Curves& curves) noexcept;
  bool hasOpposingPulls() const noexcept;
  bool limitParting(Index vertex, const DeformedBlock& surface) noexcept;
  void holdWithin(Index vertex, float room_mm, const DeformedBlock& surface) noexcept;
  void hold(Index vertex, float share, const DeformedBlock& surface) noexcept;
  void noteHeld(Index vertex) noexcept;
  void notePinning(Index vertex) noexcept;
  bool findFolds(const DeformedBlock& surface, std::span<const BlockPart> doubtful) noexcept;
  void listFold(Index triangle) noexcept;
  void drawTogether(Index triangle, const DeformedBlock& surface) noexcept;
  bool drawAllTogether(const DeformedBlock& surface) noexcept;
  void findFoldsAt(const DeformedBlock& surface, Index vertex) noexcept;
  void listIfFolded(Index triangle, const DeformedBlock& surface) noexcept;
  void shorten(const DeformedBlock& surface) noexcept;
  float shareWithoutFolds(const DeformedBlock& surface) const noexcept;

  template <class Visit>
  void forEachMoved(const Visit& visit) const noexcept {
    for (const Index block : blocks_) {
      forEachBit(regions_[block], [&](Index bit) { visit(block * kBlockVertices + bit); });
    }
  }

  const Skin& skin_;
  std::span<const Pull> pulls_;
  EdgeDistances from_staying_;
  EdgeDistances from_anchor_;
  std::vector<std::uint64_t> regions_;  // regions of all pulls; one bit a vertex
  std::vector<Index> blocks_;           // where that is not 0
  std::vector<std::uint64_t> region_;   // region of one pull
  std::vector<std::uint64_t> doubts_;   // moved vertices at which triangles are looked at, during findFolds
  std::vector<float> room_;             // room of a moved vertex along the surface, by all pulls
  std::vector<Torn> torn_;
  std::vector<Index> pinning_;  // vertices that stay next to some that move
  std::vector<std::uint64_t> is_pinning_;
  std::vector<Index> held_;
  std::vector<std::uint64_t> is_held_;
  std::vector<Index> folds_;              // triangles
  std::vector<Index> next_folds_;         // likewise
  std::vector<std::uint64_t> is_listed_;  // one bit a triangle
};

template <class Curves>
void ShearLimit::taper(const DeformedBlock& surface, double slope, const Curves& curves) noexcept {
  from_staying_.start();
  torn_.clear();
  double most = 0.0;
  for (const Pull& pull : pulls_) {
    const double own = pull.press_mm + pull.drag_mm;
    const double at_edge = seedAtEdges(pull, slope, surface);
    if (at_edge > kFaint * own) torn_.push_back({&pull, shareMeasured(at_edge / own)});
    most += own;
  }
  taperBesideStaying(most, slope, surface);
  if (!torn_.empty()) {
    roomAlongSurface(curves);
    forEachMoved([&](Index v) { holdWithin(v, room_[v], surface); });
  }
  for (const Index v : from_staying_.reached()) holdWithin(v, kSteepest * from_staying_.at(v), surface);
}

template <class Curves>
void ShearLimit::roomAlongSurface(const Curves& curves) noexcept {
  forEachMoved([&](Index v) { room_[v] = 0.0f; });
  for (const Pull& pull : pulls_) {
    const auto torn = std::find_if(torn_.begin(), torn_.end(), [&](const Torn& t) { return t.pull == &pull; });
    const double measured = torn == torn_.end() ? 0.0 : torn->share;
    if (measured > 0.0) measureAlongSurface(pull);
    for (const BlockPart& part : pull.region) {
      forEachBit(part.vertices, [&](Index bit) {
        const Index v = part.block * kBlockVertices + bit;
        // With several pulls, none leaves the others room that it does not need.
        double room = pulls_.size() > 1 ? curves.moved(pull, v) + kRoundingMm : pull.press_mm + pull.drag_mm;
        if (measured > 0.0) {
          const double away = from_anchor_.at(v) / kRoundabout;
          const double along = pull.press_mm * curves.press(pull, away / pull.press_reach_mm) +
                               pull.drag_mm * curves.drag(pull, away / pull.drag_reach_mm);
          room += measured * (std::min(along, room) - room);
        }
        room_[v] += static_cast<float>(room);
      });
    }
  }
}

}  // namespace palpate::deform
