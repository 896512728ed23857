// Two columns next to the body. In each the plates are ordered by height, are as near to the height of their dots as
// the sum of squares allows, and swap places with a neighbour as long as their lines cross. Where a column is full the
// highest rank is dropped as a whole, on both sides.
//
// Heights by pooling adjacent violators: Ayer and others, "An empirical distribution function for sampling with
// incomplete information", 1955.
#include "palpate/view/overlays/plates.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace palpate::view {

namespace {

constexpr float kBesideBody = 22.0f;    ///< between the body and a column
constexpr float kBetweenPlates = 2.0f;  ///< plates of a column
constexpr float kRoundDot = 6.0f;

struct NameColumn {
  std::vector<std::size_t> tags;
  bool right = false;
  float left_edge = 0.0f;
  float right_edge = 0.0f;
  float inner() const { return right ? left_edge : right_edge; }
};

/// A range of free heights.
struct FreeStretch {
  float top = 0.0f;
  float below = 0.0f;
  float length() const { return below - top; }
};

bool isFree(const NameTag& tag, const NameGround& ground) {
  const Vec2f reach = Vec2f::Constant(kRoundDot);
  const LabelBox dot{tag.dot - reach, tag.dot + reach};
  const bool on_page = tag.dot.allFinite() && (tag.dot.array() >= ground.page.corner.array()).all() &&
                       (tag.dot.array() <= ground.page.opposite.array()).all();
  return on_page && std::none_of(ground.taken.begin(), ground.taken.end(),
                                 [&](const LabelBox& box) { return overlapArea(dot, box) > 0.0f; });
}

/// The spine goes to one side as a whole, so that its levels stay in a row: right unless it is clearly left.
bool spineIsLeft(std::span<const NameTag> tags, const NameGround& ground, float middle) {
  constexpr float kClearly = 0.06f;  // share of the body's width; a straight spine must not depend on rounding
  float aside = 0.0f;
  float count = 0.0f;
  for (const NameTag& tag : tags) {
    if (!tag.in_middle || !isFree(tag, ground)) continue;
    aside += tag.dot.x() - middle;
    count += 1.0f;
  }
  return aside < -kClearly * count * (ground.body_right - ground.body_left);
}

/// For a lying body the spine goes across the page, and its ends are nearest to different columns.
bool spineIsUpright(std::span<const NameTag> tags, const NameGround& ground) {
  Eigen::AlignedBox2f spine;
  for (const NameTag& tag : tags) {
    if (tag.in_middle && isFree(tag, ground)) spine.extend(tag.dot);
  }
  return spine.isEmpty() || spine.sizes().y() >= spine.sizes().x();
}

std::array<NameColumn, 2> splitIntoColumns(std::span<const NameTag> tags, const NameGround& ground) {
  const float middle = 0.5f * (ground.body_left + ground.body_right);
  const bool spine_left = spineIsLeft(tags, ground, middle);
  const bool upright = spineIsUpright(tags, ground);
  std::array<NameColumn, 2> sides;
  sides[1].right = true;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    if (!isFree(tags[i], ground)) continue;
    const bool right = tags[i].in_middle && upright ? !spine_left : tags[i].dot.x() >= middle;
    sides[right ? 1 : 0].tags.push_back(i);
  }
  return sides;
}

/// Outside the body if the page has room for the widest plate there, else outside the dots, else at the page's edge.
void setEdges(std::span<const NameTag> tags, const NameGround& ground, NameColumn& column) {
  float widest = 0.0f;
  float outermost = 0.0f;  // outwards from the page's middle line
  const float out = column.right ? 1.0f : -1.0f;
  for (const std::size_t i : column.tags) {
    widest = std::max(widest, tags[i].size.x());
    const float dot = out * tags[i].dot.x();
    outermost = i == column.tags.front() ? dot : std::max(outermost, dot);
  }
  const float last = out * (column.right ? ground.page.opposite.x() : ground.page.corner.x()) - widest;
  const float beside_body = out * (column.right ? ground.body_right : ground.body_left) + kBesideBody;
  const float inner = beside_body <= last ? beside_body : std::min(outermost + kBesideBody, last);
  column.left_edge = column.right ? std::floor(inner) : std::ceil(-inner - widest);
  column.right_edge = column.left_edge + widest;
}

/// The longest free part of the page's height for a column.
FreeStretch freeStretch(const NameColumn& column, const NameGround& ground) {
  std::vector<FreeStretch> lying;
  for (const LabelBox& box : ground.taken) {
    if (box.corner.x() < column.right_edge && box.opposite.x() > column.left_edge) {
      lying.push_back({box.corner.y(), box.opposite.y()});
    }
  }
  lying.push_back({ground.page.opposite.y() + kBetweenPlates, ground.page.opposite.y() + kBetweenPlates});
  std::sort(lying.begin(), lying.end(), [](const FreeStretch& a, const FreeStretch& b) { return a.top < b.top; });
  FreeStretch best;
  float from = ground.page.corner.y();
  for (const FreeStretch& next : lying) {
    const FreeStretch gap{from, next.top - kBetweenPlates};
    if (gap.length() > best.length()) best = gap;
    from = std::max(from, next.below + kBetweenPlates);
  }
  return best;
}

float columnHeight(std::span<const NameTag> tags, const std::vector<std::size_t>& column) {
  float height = -kBetweenPlates;
  for (const std::size_t i : column) height += tags[i].size.y() + kBetweenPlates;
  return height;
}

void orderFromAbove(std::span<const NameTag> tags, std::vector<std::size_t>& column) {
  std::stable_sort(column.begin(), column.end(), [&](std::size_t a, std::size_t b) {
    return std::pair(tags[a].dot.y(), tags[a].dot.x()) < std::pair(tags[b].dot.y(), tags[b].dot.x());
  });
}

void dropFromRank(std::span<const NameTag> tags, int rank, std::vector<std::size_t>& column) {
  std::erase_if(column, [&](std::size_t i) { return tags[i].rank >= rank; });
}

/// The least rank without room in a column; empty: there is room for all, or for none.
std::optional<int> rankWithoutRoom(std::span<const NameTag> tags, float room, std::vector<std::size_t> column) {
  const auto rank_below = [&](std::size_t a, std::size_t b) { return tags[a].rank < tags[b].rank; };
  std::optional<int> without;
  while (!column.empty() && columnHeight(tags, column) > room) {
    const auto [least, most] = std::minmax_element(column.begin(), column.end(), rank_below);
    if (tags[*least].rank == tags[*most].rank) break;
    without = tags[*most].rank;
    dropFromRank(tags, *without, column);
  }
  return without;
}

/// Upper edges of the plates, in this order.
std::vector<float> computePlateTops(std::span<const NameTag> tags, const std::vector<std::size_t>& column,
                                    const FreeStretch& stretch) {
  struct Block {
    float sum = 0.0f;  // over the desired tops of its plates, less the plates above them
    float count = 0.0f;
    float mean() const { return sum / count; }
  };
  std::vector<Block> blocks;
  float above = 0.0f;
  for (const std::size_t i : column) {
    blocks.push_back({tags[i].dot.y() - 0.5f * tags[i].size.y() - above, 1.0f});
    above += tags[i].size.y() + kBetweenPlates;
    while (blocks.size() > 1 && blocks[blocks.size() - 2].mean() > blocks.back().mean()) {
      const Block last = blocks.back();
      blocks.pop_back();
      blocks.back().sum += last.sum;
      blocks.back().count += last.count;
    }
  }
  const float last_start = std::max(stretch.top, stretch.below - columnHeight(tags, column));
  std::vector<float> tops;
  above = 0.0f;
  for (const Block& block : blocks) {
    const float start = std::clamp(block.mean(), stretch.top, last_start);
    for (float n = 0.0f; n < block.count; n += 1.0f) {
      tops.push_back(std::round(start + above));
      above += tags[column[tops.size() - 1]].size.y() + kBetweenPlates;
    }
  }
  return tops;
}

float crossProduct(const Vec2f& a, const Vec2f& b) { return a.x() * b.y() - a.y() * b.x(); }

bool linesMeet(const Vec2f& a, const Vec2f& b, const Vec2f& c, const Vec2f& d) {
  return crossProduct(b - a, c - a) * crossProduct(b - a, d - a) < 0.0f &&
         crossProduct(d - c, a - c) * crossProduct(d - c, b - c) < 0.0f;
}

std::vector<NamePlate> placePlates(std::span<const NameTag> tags, const NameColumn& column,
                                   const std::vector<float>& tops) {
  std::vector<NamePlate> plates;
  for (std::size_t i = 0; i < tops.size(); ++i) {
    const Vec2f size = tags[column.tags[i]].size;
    const Vec2f corner(column.right ? column.left_edge : column.right_edge - size.x(), tops[i]);
    plates.push_back({column.tags[i], {corner, corner + size}, {column.inner(), tops[i] + 0.5f * size.y()}});
  }
  return plates;
}

/// Neighbours whose lines cross change places; a few rounds, because that can make others cross.
std::vector<NamePlate> untangled(std::span<const NameTag> tags, NameColumn column, const FreeStretch& stretch) {
  constexpr int kMaxRounds = 12;
  std::vector<NamePlate> plates = placePlates(tags, column, computePlateTops(tags, column.tags, stretch));
  for (int round = 0; round < kMaxRounds; ++round) {
    bool changed = false;
    for (std::size_t i = 0; i + 1 < plates.size(); ++i) {
      const NamePlate& a = plates[i];
      const NamePlate& b = plates[i + 1];
      if (!linesMeet(a.line_from, tags[a.tag].dot, b.line_from, tags[b.tag].dot)) continue;
      std::swap(column.tags[i], column.tags[i + 1]);
      changed = true;
      ++i;
    }
    if (!changed) break;
    plates = placePlates(tags, column, computePlateTops(tags, column.tags, stretch));
  }
  return plates;
}

}  // namespace

std::vector<NamePlate> nameColumns(std::span<const NameTag> tags, const NameGround& ground) {
  std::array<NameColumn, 2> sides = splitIntoColumns(tags, ground);
  for (NameColumn& column : sides) setEdges(tags, ground, column);
  std::array<FreeStretch, 2> stretches;
  std::optional<int> given_up;
  for (std::size_t side = 0; side < 2; ++side) {
    std::vector<std::size_t>& column = sides[side].tags;
    std::erase_if(column, [&](std::size_t i) {  // close to the skin, columns may cover dots
      return std::any_of(sides.begin(), sides.end(), [&](const NameColumn& over) {
        const float x = tags[i].dot.x();
        return over.right_edge > over.left_edge && x > over.left_edge - kRoundDot && x < over.right_edge + kRoundDot;
      });
    });
    stretches[side] = freeStretch(sides[side], ground);
    const auto without = rankWithoutRoom(tags, stretches[side].length(), column);
    if (without) given_up = std::min(*without, given_up.value_or(*without));
  }
  std::vector<NamePlate> plates;
  for (std::size_t side = 0; side < 2; ++side) {
    std::vector<std::size_t>& column = sides[side].tags;
    if (given_up) dropFromRank(tags, *given_up, column);
    orderFromAbove(tags, column);
    while (!column.empty() && columnHeight(tags, column) > stretches[side].length()) column.pop_back();
    const auto its_plates = untangled(tags, sides[side], stretches[side]);
    plates.insert(plates.end(), its_plates.begin(), its_plates.end());
  }
  return plates;
}

}  // namespace palpate::view
