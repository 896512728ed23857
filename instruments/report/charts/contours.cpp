// Lines of equal value through a field.
//
// Marching squares with linear interpolation along the grid's edges, the pieces joined into lines; a cell with a corner
// outside (NaN) has none.
// Based on: Lorensen and Cline, "Marching cubes", 1987, in two dimensions.
#include "report/charts/drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <map>
#include <utility>

namespace palpate::figures {

namespace {

// A grid edge, numbered by its lower left value: twice the value's index, plus one for the edge upwards.
using Edge = std::int64_t;
using EdgePair = std::array<Edge, 2>;  // joined by a piece of the contour

struct Corner {
  int column;
  int row;
};

class Tracer {
 public:
  Tracer(const Field& field, double level) : field_(field), level_(level) {}

  std::vector<EdgePair> pieces() const {
    std::vector<EdgePair> found;
    for (int row = 0; row + 1 < field_.rows; ++row) {
      for (int column = 0; column + 1 < field_.columns; ++column) addCell(column, row, found);
    }
    return found;
  }

  Vec2 place(Edge edge) const {
    const auto index = static_cast<int>(edge / 2);
    const Corner a{index % field_.columns, index / field_.columns};
    const Corner b = edge % 2 == 0 ? Corner{a.column + 1, a.row} : Corner{a.column, a.row + 1};
    const double share = (level_ - value(a)) / (value(b) - value(a));
    return position(a) + share * (position(b) - position(a));
  }

 private:
  double value(Corner c) const { return field_.values[static_cast<std::size_t>(c.row) * field_.columns + c.column]; }
  Vec2 position(Corner c) const { return field_.origin + Vec2(c.column * field_.step.x(), c.row * field_.step.y()); }
  bool isAbove(Corner c) const { return value(c) >= level_; }
  Edge edgeFrom(Corner c, bool upwards) const {
    return 2 * (static_cast<Edge>(c.row) * field_.columns + c.column) + (upwards ? 1 : 0);
  }

  void addCell(int column, int row, std::vector<EdgePair>& found) const {
    const std::array corners{Corner{column, row}, Corner{column + 1, row}, Corner{column + 1, row + 1},
                             Corner{column, row + 1}};
    for (const Corner c : corners) {
      if (!std::isfinite(value(c))) return;
    }
    // The cell's sides in order: below, right, above, left; side i runs from corner i to the next.
    const std::array sides{edgeFrom(corners[0], false), edgeFrom(corners[1], true), edgeFrom(corners[3], false),
                           edgeFrom(corners[0], true)};
    std::vector<Edge> crossed;
    for (std::size_t i = 0; i < 4; ++i) {
      if (isAbove(corners[i]) != isAbove(corners[(i + 1) % 4])) crossed.push_back(sides[i]);
    }
    if (crossed.size() == 2) found.push_back({crossed[0], crossed[1]});
    if (crossed.size() == 4) addSaddle(corners, crossed, found);
  }

  // Two lines through one cell: the mean of the corners decides which corners belong together.
  void addSaddle(const std::array<Corner, 4>& corners, const std::vector<Edge>& sides,
                 std::vector<EdgePair>& found) const {
    double mean = 0.0;
    for (const Corner c : corners) mean += 0.25 * value(c);
    const bool joined = (mean >= level_) == isAbove(corners[0]);
    if (joined) {
      found.push_back({sides[0], sides[1]});
      found.push_back({sides[2], sides[3]});
    } else {
      found.push_back({sides[3], sides[0]});
      found.push_back({sides[1], sides[2]});
    }
  }

  const Field& field_;
  double level_;
};

// Pieces that share an edge follow each other.
class Joiner {
 public:
  explicit Joiner(std::vector<EdgePair> pieces) : pieces_(std::move(pieces)), used_(pieces_.size(), false) {
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      for (const Edge edge : pieces_[i]) at_edge_.emplace(edge, i);
    }
  }

  std::vector<std::deque<Edge>> lines() {
    std::vector<std::deque<Edge>> lines;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (used_[i]) continue;
      used_[i] = true;
      std::deque<Edge> line{pieces_[i][0], pieces_[i][1]};
      while (const Edge* next = step(line.back())) line.push_back(*next);
      while (const Edge* next = step(line.front())) line.push_front(*next);
      lines.push_back(std::move(line));
    }
    return lines;
  }

 private:
  // The far end of an unused piece at this edge.
  const Edge* step(Edge end) {
    const auto [first, last] = at_edge_.equal_range(end);
    for (auto entry = first; entry != last; ++entry) {
      if (used_[entry->second]) continue;
      used_[entry->second] = true;
      const EdgePair& piece = pieces_[entry->second];
      return piece[0] == end ? &piece[1] : &piece[0];
    }
    return nullptr;
  }

  std::vector<EdgePair> pieces_;
  std::vector<bool> used_;
  std::multimap<Edge, std::size_t> at_edge_;
};

}  // namespace

std::vector<std::vector<Vec2>> contourLines(const Field& field, double level) {
  const Tracer tracer(field, level);
  std::vector<std::vector<Vec2>> lines;
  for (const std::deque<Edge>& edges : Joiner(tracer.pieces()).lines()) {
    std::vector<Vec2>& line = lines.emplace_back();
    for (const Edge edge : edges) line.push_back(tracer.place(edge));
  }
  return lines;
}

}  // namespace palpate::figures
