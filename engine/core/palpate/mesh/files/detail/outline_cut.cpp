// A sweep from left to right (at equal x from below upwards). Between two neighbouring sides on the sweep line there is
// a stretch; one within the outline keeps a chain of places, from the lower side to the upper one, that is the
// front of what has been cut so far. The place that the sweep reaches is joined with the visible places of the chains
// next to it.
//
// Sides on top of each other are one with the sum of their directions, and vanish where that is zero, as bridges do. A
// place on a side divides it.
//
// Based on: Hertel, Mehlhorn, "Fast triangulation of simple polygons" (1983), the chains; Shamos, Hoey, "Geometric
// intersection problems" (1976): sides that cross are neighbours before.
#include "palpate/mesh/files/detail/outline_cut.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "palpate/base/exact_sum.h"

namespace palpate::mesh {

namespace {

/// A place's number is its rank in the sweep, so `left < right`.
struct Side {
  Index left;
  Index right;
  int turns;              ///< growth of the winding number from below it to above
  Index next = kNoIndex;  ///< another that starts at the same place
};

struct Link {
  Index place;
  Index lower = kNoIndex;
  Index upper = kNoIndex;
};

struct Chain {
  Index first = kNoIndex;   ///< link at the lower side
  Index last = kNoIndex;    ///< link at the upper side
  Index latest = kNoIndex;  ///< the one farthest to the right: the next place sees it for certain
};

/// The region above a side, up to the next one.
struct Stretch {
  int winding = 0;
  Chain chain;
};

class Sweep {
 public:
  explicit Sweep(std::span<const Vec2> corners) {
    placeCorners(corners);
    const std::size_t n = corners.size();
    first_side_.assign(places_.size(), kNoIndex);
    sides_.reserve(2 * n);
    for (std::size_t k = 0; k < n; ++k) {
      const Index from = place_of_[k];
      const Index to = place_of_[k + 1 == n ? 0 : k + 1];
      if (from < to) addSide(from, to, 1);
      if (to < from) addSide(to, from, -1);
    }
  }

  bool run() {
    triangles_.reserve(places_.size());
    links_.reserve(2 * places_.size());
    for (Index p = 0; p < places_.size(); ++p) {
      if (!visit(p)) return false;
    }
    return true;
  }

  std::vector<Triangle> extractTriangles() {
    for (Triangle& triangle : triangles_) {
      for (Index& place : triangle) place = corner_at_[place];
    }
    return std::move(triangles_);
  }

 private:
  struct At {
    Index place;
  };
  struct Upwards {
    using is_transparent = void;
    const Sweep* sweep;
    bool operator()(Index lower, Index upper) const { return sweep->isBelow(lower, upper); }
    bool operator()(Index side, At at) const { return sweep->turnAt(side, at.place) > 0; }
    bool operator()(At at, Index side) const { return sweep->turnAt(side, at.place) < 0; }
  };
  using Line = std::set<Index, Upwards>;

  // --- places and sides

  void placeCorners(std::span<const Vec2> corners) {
    std::vector<Index> order(corners.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
      const Vec2& at = corners[a];
      const Vec2& other = corners[b];
      if (at.x() != other.x()) return at.x() < other.x();
      if (at.y() != other.y()) return at.y() < other.y();
      return a < b;
    });
    place_of_.resize(corners.size());
    for (const Index corner : order) {
      if (places_.empty() || places_.back() != corners[corner]) {
        places_.push_back(corners[corner]);
        corner_at_.push_back(corner);
      }
      place_of_[corner] = static_cast<Index>(places_.size() - 1);
    }
  }

  void addSide(Index left, Index right, int turns) {
    sides_.push_back({left, right, turns, first_side_[left]});
    first_side_[left] = static_cast<Index>(sides_.size() - 1);
  }

  int turn(Index a, Index b, Index c) const { return orient2d(places_[a], places_[b], places_[c]); }
  int turnAt(Index side, Index place) const { return turn(sides_[side].left, sides_[side].right, place); }

  bool isBelow(Index lower, Index upper) const {
    const Side& a = sides_[lower];
    const Side& b = sides_[upper];
    if (a.left == b.left) return turnAt(lower, b.right) > 0;
    return a.left < b.left ? turnAt(lower, b.left) > 0 : turnAt(upper, a.left) < 0;
  }

  bool cross(Index first, Index second) const {
    const Side& a = sides_[first];
    const Side& b = sides_[second];
    return turnAt(first, b.left) * turnAt(first, b.right) < 0 && turnAt(second, a.left) * turnAt(second, a.right) < 0;
  }

  // --- chains

  Index newLink(Index place) {
    links_.push_back({place});
    return static_cast<Index>(links_.size() - 1);
  }

  void join(Index lower, Index upper) {
    links_[lower].upper = upper;
    links_[upper].lower = lower;
  }

  /// The triangle of p and two neighbours on a chain, where p sees them.
  bool cut(Index lower, Index p, Index upper) {
    const Triangle triangle = {links_[lower].place, p, links_[upper].place};
    if (turn(triangle[0], triangle[1], triangle[2]) <= 0) return false;
    triangles_.push_back(triangle);
    return true;
  }

  void addAbove(Chain& chain, Index p) {
    while (chain.last != chain.first && cut(links_[chain.last].lower, p, chain.last)) {
      chain.last = links_[chain.last].lower;
    }
    const Index added = newLink(p);
    join(chain.last, added);
    chain.last = chain.latest = added;
  }

  void addBelow(Chain& chain, Index p) {
    while (chain.first != chain.last && cut(chain.first, p, links_[chain.first].upper)) {
      chain.first = links_[chain.first].upper;
    }
    const Index added = newLink(p);
    join(added, chain.first);
    chain.first = chain.latest = added;
  }

  /// The stretch ends in p, which sees all of its chain.
  bool close(const Chain& chain, Index p) {
    for (Index at = chain.first; at != chain.last; at = links_[at].upper) {
      if (!cut(at, p, links_[at].upper)) return false;
    }
    return true;
  }

  /// p is within the stretch: the chain becomes one that ends in p (`chain`) and one that starts there (returned).
  Chain divide(Chain& chain, Index p) {
    Index down = chain.latest;
    Index up = chain.latest;
    while (down != chain.first && cut(links_[down].lower, p, down)) down = links_[down].lower;
    while (up != chain.last && cut(up, p, links_[up].upper)) up = links_[up].upper;
    Chain above{newLink(p), chain.last, kNoIndex};
    above.latest = above.first;
    const Index copy = newLink(links_[up].place);  // `down` may be the same link
    join(above.first, copy);
    if (up == chain.last) {
      above.last = copy;
    } else {
      join(copy, links_[up].upper);
    }
    chain.last = chain.latest = newLink(p);
    join(down, chain.last);
    return above;
  }

  // --- one place

  bool visit(Index p) {
    starting_.clear();
    for (Index side = first_side_[p]; side != kNoIndex; side = sides_[side].next) starting_.push_back(side);
    const auto lowest = line_.lower_bound(At{p});
    const bool is_on_a_side = lowest != line_.end() && turnAt(*lowest, p) == 0;
    const Index below = lowest == line_.begin() ? kNoIndex : *std::prev(lowest);
    Stretch outside;
    Stretch& bottom = below == kNoIndex ? outside : stretches_[below];
    Stretch top = bottom;
    auto next = lowest;
    if (is_on_a_side) {
      if (bottom.winding == 1) addAbove(bottom.chain, p);
      if (!endSides(next, p, top)) return false;
    }
    uniteStarting(p);
    if (!is_on_a_side) {
      if (starting_.empty()) return true;  // nothing but bridges meet here
      if (bottom.winding == 1) top.chain = divide(bottom.chain, p);
    }
    return startSides(next, p, below, bottom, top);
  }

  /// Removes the sides through p from the line; those that continue start again.
  bool endSides(Line::iterator& next, Index p, Stretch& top) {
    while (next != line_.end() && turnAt(*next, p) == 0) {
      const Side side = sides_[*next];
      const Stretch& above = stretches_[*next];
      next = line_.erase(next);
      if (side.right != p) {
        sides_.push_back({p, side.right, side.turns});
        starting_.push_back(static_cast<Index>(sides_.size() - 1));
      }
      top = above;
      const bool is_topmost = next == line_.end() || turnAt(*next, p) != 0;
      if (top.winding != 1) continue;
      if (is_topmost) {
        addBelow(top.chain, p);
      } else if (!close(top.chain, p)) {
        return false;
      }
    }
    return true;
  }

  bool startSides(Line::iterator next, Index p, Index below, Stretch& bottom, const Stretch& top) {
    if (starting_.empty()) {
      if (bottom.winding != top.winding) return false;
      if (bottom.winding == 1) {
        join(bottom.chain.last, links_[top.chain.first].upper);  // p is the end of one and the start of the other
        bottom.chain.last = top.chain.last;
      }
      return below == kNoIndex || next == line_.end() || !cross(below, *next);
    }
    int winding = bottom.winding;
    stretches_.resize(std::max(stretches_.size(), sides_.size()));  // `bottom` is not used any more
    for (const Index side : starting_) {
      winding += sides_[side].turns;
      if (winding != 0 && winding != 1) return false;
      stretches_[side].winding = winding;
      if (side == starting_.back()) {
        stretches_[side].chain = top.chain;
      } else if (winding == 1) {
        const Index start = newLink(p);
        stretches_[side].chain = {start, start, start};
      }
      line_.insert(next, side);
    }
    if (winding != top.winding) return false;
    return (below == kNoIndex || !cross(below, starting_.front())) &&
           (next == line_.end() || !cross(starting_.back(), *next));
  }

  /// Sides that start at p, from below upwards; of those on top of each other the shortest, with the sum of their
  /// turns. The others continue from its end.
  void uniteStarting(Index p) {
    std::sort(starting_.begin(), starting_.end(), [&](Index a, Index b) {
      const int sign = turn(p, sides_[a].right, sides_[b].right);
      return sign != 0 ? sign > 0 : sides_[a].right < sides_[b].right;
    });
    std::size_t kept = 0;
    for (std::size_t first = 0, end = 0; first < starting_.size(); first = end) {
      int turns = 0;
      for (end = first; end < starting_.size(); ++end) {
        const Index longer = starting_[end];
        if (turn(p, sides_[starting_[first]].right, sides_[longer].right) != 0) break;
        turns += sides_[longer].turns;
      }
      const Index united = starting_[first];
      addRemainingSides(first, end, turns);
      sides_[united].turns = turns;
      if (turns != 0) starting_[kept++] = united;
    }
    starting_.resize(kept);
  }

  /// Walks the united sides [first, end): from each end to the next with the turns of the longer ones.
  void addRemainingSides(std::size_t first, std::size_t end, int turns) {
    for (std::size_t i = first; i + 1 < end; ++i) {
      turns -= sides_[starting_[i]].turns;
      const Index from = sides_[starting_[i]].right;
      const Index to = sides_[starting_[i + 1]].right;
      if (from != to && turns != 0) addSide(from, to, turns);
    }
  }

  std::vector<Vec2> places_;
  std::vector<Index> corner_at_;  // by place
  std::vector<Index> place_of_;   // by corner
  std::vector<Side> sides_;
  std::vector<Index> first_side_;   // by place
  std::vector<Stretch> stretches_;  // above each side
  std::vector<Link> links_;
  std::vector<Index> starting_;
  std::vector<Triangle> triangles_;
  Line line_ = Line(Upwards{this});
};

}  // namespace

std::optional<std::vector<Triangle>> triangulateOutline(std::span<const Vec2> corners) {
  if (corners.size() < 3) return std::nullopt;
  Sweep sweep(corners);
  if (!sweep.run()) return std::nullopt;
  return sweep.extractTriangles();
}

}  // namespace palpate::mesh
