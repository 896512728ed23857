// The cut-away on its plate: tissue a column of points at a time, borders as curves over it, contents clipped to the
// field. In each picture with it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "palpate/base/language.h"
#include "palpate/view/layers/drawing.h"
#include "palpate/view/overlays/cut_away.h"
#include "palpate/view/overlays/legend.h"
#include "palpate/view/overlays/marks.h"

namespace palpate::view {

namespace {

constexpr float kCutPad = 7.0f;
constexpr float kCutLine = 17.0f;  ///< a line of words

constexpr Ink kSkinLayer{{226, 178, 150}};
constexpr Ink kFatLayer{{244, 220, 146}};
constexpr Ink kMuscleLayer{{178, 84, 76}};
constexpr Ink kOtherLayer{{206, 140, 118}};
constexpr Ink kBone{{236, 232, 220}};
constexpr Ink kBorder{{60, 40, 36}, 0.55};
constexpr Ink kOnTissue{{24, 18, 18}};
constexpr Ink kLumpInk{{kLumpPaint[0], kLumpPaint[1], kLumpPaint[2]}};
constexpr Ink kLumpRim{{44, 26, 96}};

const Ink& inkOfLayer(const std::string& name) {
  if (name == "skin") return kSkinLayer;
  if (name == "fat") return kFatLayer;
  return name == "muscle" ? kMuscleLayer : kOtherLayer;
}

std::string wordOfLayer(const std::string& name) {
  if (name == "skin") return tr("skin");
  if (name == "fat") return tr("fat");
  if (name == "muscle") return tr("muscle");
  return name.empty() ? std::string(tr("tissue")) : name;
}

/// From mm of the plane to the page.
struct CutField {
  Vec2 low, high;
  Vec2f corner, extent;

  Vec2f opposite() const { return corner + extent; }
  Vec2f at(const Vec2& mm) const {
    const Vec2 share = (mm - low).cwiseQuotient(high - low);
    return corner + Vec2f(static_cast<float>(share.x()) * extent.x(), static_cast<float>(1.0 - share.y()) * extent.y());
  }
  float pointsPerMm() const { return static_cast<float>(extent.x() / (high.x() - low.x())); }
};

/// The height of a border at a place along the cut: the highest, where it turns back on itself.
std::optional<double> heightAt(std::span<const Vec2> border, double along_mm) {
  double highest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < border.size(); ++i) {
    const Vec2& a = border[i - 1];
    const Vec2& b = border[i];
    if ((a.x() <= along_mm) == (b.x() <= along_mm)) continue;
    highest = std::max(highest, std::lerp(a.y(), b.y(), (along_mm - a.x()) / (b.x() - a.x())));
  }
  return std::isfinite(highest) ? std::optional(highest) : std::nullopt;
}

/// From `from_mm` down to `to_mm` in a column of the page, clipped to the field.
void fillColumn(Drawing& page, const CutField& field, float x, double from_mm, double to_mm, const Ink& ink) {
  const float top = std::clamp(field.at({0.0, from_mm}).y(), field.corner.y(), field.opposite().y());
  const float below = std::clamp(field.at({0.0, to_mm}).y(), field.corner.y(), field.opposite().y());
  if (below > top) page.box({x, top}, {x + 1.0f, below}, ink);
}

void fillTissue(Drawing& page, const CutAway& cut, const CutField& field) {
  for (float x = field.corner.x(); x < field.opposite().x() - 0.5f; x += 1.0f) {
    const double share = (x + 0.5f - field.corner.x()) / field.extent.x();
    const double along_mm = std::lerp(field.low.x(), field.high.x(), share);
    const auto skin = heightAt(cut.skin, along_mm);
    if (!skin) continue;
    double above = *skin;
    for (const CutAway::Layer& layer : cut.layers) {
      const double below = std::min(above, heightAt(layer.below, along_mm).value_or(above));
      fillColumn(page, field, x, above, below, inkOfLayer(layer.name));
      above = below;
    }
    fillColumn(page, field, x, above, field.low.y() - 1.0, cut.layers.empty() ? kOtherLayer : kBone);
  }
}

/// Clips a convex outline to the field, one edge after the other.
std::vector<Vec2f> clippedTo(const CutField& field, std::vector<Vec2f> outline) {
  const std::array<std::pair<int, float>, 4> edges = {
      {{0, field.corner.x()}, {0, field.opposite().x()}, {1, field.corner.y()}, {1, field.opposite().y()}}};
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto& [axis, at] = edges[e];
    const float sign = e % 2 == 0 ? 1.0f : -1.0f;
    std::vector<Vec2f> kept;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Vec2f& a = outline[i];
      const Vec2f& b = outline[(i + 1) % outline.size()];
      const float a_in = sign * (a[axis] - at), b_in = sign * (b[axis] - at);
      if (a_in >= 0.0f) kept.push_back(a);
      if ((a_in >= 0.0f) != (b_in >= 0.0f)) kept.push_back(a + a_in / (a_in - b_in) * (b - a));
    }
    outline = std::move(kept);
  }
  return outline;
}

/// Draws the pieces of a curve within the field.
void drawBorder(Drawing& page, const CutField& field, std::span<const Vec2> border, const Ink& ink, float thickness) {
  const auto inside = [&](const Vec2& p) {
    return p.x() >= field.low.x() && p.x() <= field.high.x() && p.y() >= field.low.y() && p.y() <= field.high.y();
  };
  std::vector<Vec2f> piece;
  for (const Vec2& point : border) {
    if (inside(point)) {
      piece.push_back(field.at(point));
      continue;
    }
    if (piece.size() > 1) page.curve(piece, ink, thickness);
    piece.clear();
  }
  if (piece.size() > 1) page.curve(piece, ink, thickness);
}

std::vector<Vec2f> onField(const CutField& field, std::span<const Vec2> outline) {
  std::vector<Vec2f> points;
  for (const Vec2& point : outline) points.push_back(field.at(point));
  return clippedTo(field, std::move(points));
}

void closeRim(Drawing& page, const CutField& field, std::span<const Vec2> outline, const Ink& ink, float thickness) {
  std::vector<Vec2> closed(outline.begin(), outline.end());
  if (!closed.empty()) closed.push_back(outline.front());
  drawBorder(page, field, closed, ink, thickness);
}

void drawLump(Drawing& page, const CutField& field, const CutAway::Lump& lump) {
  constexpr double kApartMm = 0.4;  // nearer to each other the two outlines are one
  const std::vector<Vec2f> filled = onField(field, lump.rim);
  const bool away =
      !lump.placed.empty() && !lump.rim.empty() && (lump.placed.front() - lump.rim.front()).norm() > kApartMm;
  page.convex(filled, kLumpInk);
  closeRim(page, field, lump.rim, kLumpRim, 1.4f);
  for (std::size_t i = 0; away && i + 1 < lump.placed.size(); i += 2) {
    drawBorder(page, field, std::span(lump.placed).subspan(i, 2), kLumpRim, 1.2f);
  }
}

void drawTip(Drawing& page, const CutField& field, const CutAway& cut) {
  constexpr int kPoints = 64;
  std::vector<Vec2> circle;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kPoints;
    circle.push_back(cut.finger + cut.finger_mm * Vec2(std::cos(angle), std::sin(angle)));
  }
  Ink ink{encodedColour(cut.colour), 0.5};
  page.convex(onField(field, circle), ink);
  ink.opacity = 1.0;
  closeRim(page, field, circle, ink, 1.6f);
}

/// 10 mm, for both directions are to scale.
void drawScale(Drawing& page, const CutField& field) {
  constexpr double kScaleMm = 10.0;
  const float length = static_cast<float>(kScaleMm) * field.pointsPerMm();
  const Vec2f from = Vec2f(field.corner.x(), field.opposite().y()) + Vec2f(8.0f, -8.0f);
  const Vec2f to = from + Vec2f(length, 0.0f);
  const float above = page.measure("0", TextSize::small).y() + 2.0f;
  page.box(from - Vec2f(4.0f, above + 3.0f), to + Vec2f(4.0f, 5.0f), {{255, 255, 255}, 0.55}, 3.0f);
  page.line(from, to, kOnTissue, 2.0f);
  page.text(0.5f * (from + to) - Vec2f(0.0f, above), "10 mm", kOnTissue, Align::centre, TextSize::small);
}

// ---- text

struct CutSign {
  Ink ink;
  std::string words;
};

std::vector<CutSign> cutSigns(const CutAway& cut) {
  std::vector<CutSign> signs;
  for (const CutAway::Layer& layer : cut.layers) signs.push_back({inkOfLayer(layer.name), wordOfLayer(layer.name)});
  if (!cut.layers.empty()) signs.push_back({kBone, tr("bone")});
  if (cut.nearest) {
    const CutAway::Lump& lump = cut.lumps[*cut.nearest];
    std::string words = trf("{}: {:.3g} kPa", lump.name, lump.young_kpa);
    if (lump.moved_mm > 0.05) words += trf(", moved {:.1f} mm", lump.moved_mm);
    signs.push_back({kLumpInk, std::move(words)});
  }
  return signs;
}

/// Lays out rows of chips with text. Returns the number of rows; draws where there is a page.
int layOutKey(Drawing& page, const std::vector<CutSign>& signs, const Vec2f& corner, float width,
              const LabelInks* inks) {
  constexpr float kChipSide = 10.0f;
  constexpr float kApart = 10.0f;
  float x = 0.0f;
  int row = 0;
  for (const CutSign& sign : signs) {
    const float needed = kChipSide + 4.0f + page.measure(sign.words, TextSize::small).x();
    if (x > 0.0f && x + needed > width) {
      x = 0.0f;
      ++row;
    }
    if (inks != nullptr) {
      const Vec2f at = corner + Vec2f(x, static_cast<float>(row) * kCutLine);
      page.box(at + Vec2f(0.0f, 2.0f), at + Vec2f(kChipSide, 2.0f + kChipSide), sign.ink, 2.0f);
      page.text(at + Vec2f(kChipSide + 4.0f, 0.0f), sign.words, inks->letter, Align::left, TextSize::small);
    }
    x += needed + kApart;
  }
  return row + 1;
}

std::string titleOf(const CutAway& cut) {
  if (cut.nearest) return trf("cut-away through {}", cut.lumps[*cut.nearest].name);
  return tr("cut-away");
}

void drawPieces(Drawing& page, const CutAway& cut, const CutField& field, const LabelInks& inks) {
  fillTissue(page, cut, field);
  for (const CutAway::Layer& layer : cut.layers) drawBorder(page, field, layer.below, kBorder, 1.0f);
  for (const CutAway::Lump& lump : cut.lumps) drawLump(page, field, lump);
  drawBorder(page, field, cut.rest, inks.rest, 1.2f);
  drawTip(page, field, cut);
  drawBorder(page, field, cut.skin, kBorder, 1.8f);
  drawScale(page, field);
  const SectionEnds ends = sectionEnds(cut.plane);
  const Vec2f inset(5.0f, 3.0f);
  writeLabel(page, field.corner + inset, ends.low, inks, Align::left, TextSize::small);
  writeLabel(page, {field.opposite().x() - inset.x(), field.corner.y() + inset.y()}, ends.high, inks, Align::right,
             TextSize::small);
}

}  // namespace

LabelBox drawCutAway(Drawing& page, const CutAway& cut, const Vec2f& lower_left, float width, const LabelInks& inks) {
  const auto signs = cutSigns(cut);
  const float inner = width - 2.0f * kCutPad;
  const int rows = layOutKey(page, signs, Vec2f::Zero(), inner, nullptr);
  CutField field{.low = cut.low, .high = cut.high, .corner = {}, .extent = {}};
  field.extent = {inner, std::round(inner / static_cast<float>(kCutAspect))};
  const float key = static_cast<float>(rows) * kCutLine;
  const Vec2f size(width, kCutLine + field.extent.y() + key + 2.5f * kCutPad);
  const Vec2f corner = lower_left - Vec2f(0.0f, size.y());
  field.corner = corner + Vec2f(kCutPad, kCutLine + kCutPad);
  page.box(corner, corner + size, inks.plate, 5.0f);
  page.text(corner + Vec2f(kCutPad, 5.0f), titleOf(cut), inks.letter, Align::left, TextSize::small);
  drawPieces(page, cut, field, inks);
  layOutKey(page, signs, {field.corner.x(), field.opposite().y() + 0.7f * kCutPad}, inner, &inks);
  return {corner, corner + size};
}

}  // namespace palpate::view
