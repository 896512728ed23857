// A surface in parallel projection by the painter's algorithm: everything is cut into small flat pieces, sorted by the
// depth of their middle and painted from back to front. Long lines and sheets are cut so that the order holds along
// them; where pieces cross each other it is approximate.
// Based on: Newell, Newell, Sancha, "A solution to the hidden surface problem", 1972 (without its splitting).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "palpate/base/language.h"
#include "report/charts/drawing.h"
#include "report/charts/legend.h"
#include "report/charts/lettering.h"
#include "report/charts/mesh_view.h"
#include "report/charts/plot_layout.h"
#include "report/charts/ticks.h"

namespace palpate::figures {

namespace {

// From the world (mm) to the panel (pixels).
class Camera {
 public:
  explicit Camera(const MeshView& view)
      : towards_(view.towards_viewer.normalized()),
        right_(view.up.cross(towards_).normalized()),
        up_(towards_.cross(right_)),
        light_((towards_ + 0.6 * up_ - 0.4 * right_).normalized()) {}

  Vec2 flat(const Vec3& point) const { return {point.dot(right_), point.dot(up_)}; }
  double depth(const Vec3& point) const { return point.dot(towards_); }
  Vec2 operator()(const Vec3& point) const {
    const Vec2 at = flat(point);
    return {offset_.x() + pixels_ * at.x(), offset_.y() - pixels_ * at.y()};
  }
  double pixelsPerMm() const { return pixels_; }
  const Vec3& light() const { return light_; }

  void fit(const Eigen::AlignedBox2d& seen, const Rect& room) {
    const Vec2 size = seen.sizes().cwiseMax(1e-9);
    pixels_ = std::min(room.width() / size.x(), room.height() / size.y());
    offset_ = Vec2(0.5 * (room.left + room.right) - pixels_ * seen.center().x(),
                   0.5 * (room.top + room.bottom) + pixels_ * seen.center().y());
  }

 private:
  Vec3 towards_;
  Vec3 right_;
  Vec3 up_;
  Vec3 light_;
  double pixels_ = 1.0;
  Vec2 offset_ = Vec2::Zero();
};

std::array<Vec3, 4> cornersOf(const Sheet& sheet) {
  return {sheet.corner, sheet.corner + sheet.side_u, sheet.corner + sheet.side_u + sheet.side_v,
          sheet.corner + sheet.side_v};
}

Eigen::AlignedBox2d seenBox(const MeshView& view, const Camera& camera) {
  Eigen::AlignedBox2d seen;
  for (const Vec3& position : view.positions) seen.extend(camera.flat(position));
  for (const Segments& lines : view.lines) {
    for (const auto& [from, to] : lines.segments) seen.extend(camera.flat(from)).extend(camera.flat(to));
  }
  for (const Sheet& sheet : view.sheets) {
    for (const Vec3& corner : cornersOf(sheet)) seen.extend(camera.flat(corner));
  }
  for (const Ball& ball : view.balls) {
    const Vec2 reach = Vec2::Constant(ball.radius);
    seen.extend(camera.flat(ball.centre) - reach).extend(Vec2(camera.flat(ball.centre) + reach));
  }
  if (seen.isEmpty()) seen.extend(Vec2(Vec2::Zero())).extend(Vec2(Vec2::Ones()));
  return seen;
}

// A flat piece, ready to be painted.
struct Piece {
  double depth = 0.0;
  std::vector<Vec2> outline;
  std::optional<Colour> fill;
  std::optional<Pen> pen;
  double radius_px = 0.0;  // a disc around the only point
};

Colour lit(const Colour& colour, double ambient, const Vec3& normal, const Vec3& light) {
  const double length = normal.norm();
  const double facing = length > 0.0 ? std::abs(normal.dot(light)) / length : 0.0;  // both sides alike
  const double brightness = ambient + (1.0 - ambient) * facing;
  return {colour.red * brightness, colour.green * brightness, colour.blue * brightness, colour.alpha};
}

class Scenery {
 public:
  Scenery(const MeshView& view, const Camera& camera) : view_(view), camera_(camera) {
    for (std::size_t t = 0; t < view.triangles.size(); ++t) addTriangle(t);
    Eigen::AlignedBox3d box;
    for (const Vec3& position : view.positions) box.extend(position);
    size_ = box.isEmpty() ? 1.0 : box.diagonal().norm();
    for (const Sheet& sheet : view.sheets) addSheet(sheet);
    for (const Ball& ball : view.balls) addBall(ball);
    for (const Segments& lines : view.lines) addSegments(lines);
  }

  void paint(Canvas& canvas) {
    std::stable_sort(pieces_.begin(), pieces_.end(), [](const Piece& a, const Piece& b) { return a.depth < b.depth; });
    for (const Piece& piece : pieces_) {
      if (piece.radius_px > 0.0) {
        canvas.disc(piece.outline.front(), piece.radius_px, piece.pen, piece.fill);
      } else {
        canvas.path(piece.outline, piece.fill.has_value(), piece.pen, piece.fill);
      }
    }
  }

 private:
  void addTriangle(std::size_t t) {
    const Triangle& corners = view_.triangles[t];
    const Vec3& a = view_.positions[corners[0]];
    const Vec3& b = view_.positions[corners[1]];
    const Vec3& c = view_.positions[corners[2]];
    const Colour base = view_.colours.empty() ? view_.colour : view_.colours[t];
    const Colour colour = lit(base, view_.ambient, (b - a).cross(c - a), camera_.light());
    // A pen of the same colour closes the hairline gaps between neighbours.
    const Pen pen = view_.edges ? Pen{withAlpha(kInk, 0.55), 0.5} : Pen{colour, 0.6};
    pieces_.push_back({camera_.depth((a + b + c) / 3.0), {camera_(a), camera_(b), camera_(c)}, colour, pen});
  }

  void addSheet(const Sheet& sheet) {
    constexpr int kCells = 32;
    const Vec3 u = sheet.side_u / kCells;
    const Vec3 v = sheet.side_v / kCells;
    for (int i = 0; i < kCells; ++i) {
      for (int j = 0; j < kCells; ++j) addSheetCell(sheet.corner + i * u + j * v, u, v, sheet.colour);
    }
  }

  void addSheetCell(const Vec3& corner, const Vec3& u, const Vec3& v, const Colour& colour) {
    pieces_.push_back({camera_.depth(corner + 0.5 * (u + v)),
                       {camera_(corner), camera_(corner + u), camera_(corner + u + v), camera_(corner + v)},
                       colour,
                       std::nullopt});
  }

  void addBall(const Ball& ball) {
    const double radius = ball.radius * camera_.pixelsPerMm();
    // Whole, also where it sits half in the surface: by the depth of its front.
    pieces_.push_back(
        {camera_.depth(ball.centre) + ball.radius, {camera_(ball.centre)}, ball.colour, Pen{kInk, 0.6}, radius});
  }

  void addSegments(const Segments& lines) {
    constexpr double kLongestPiece = 0.02;  // share of the surface's size
    constexpr double kInFront = 0.004;      // so that a line on the surface is not half hidden in it
    const double bias = lines.on_top ? std::numeric_limits<double>::max() : kInFront * size_;
    for (const auto& [from, to] : lines.segments) {
      const int count = 1 + static_cast<int>((to - from).norm() / (kLongestPiece * size_));
      for (int i = 0; i < count; ++i) {
        const Vec3 a = from + (to - from) * (static_cast<double>(i) / count);
        const Vec3 b = from + (to - from) * (static_cast<double>(i + 1) / count);
        const double depth = lines.on_top ? bias : camera_.depth(0.5 * (a + b)) + bias;
        pieces_.push_back({depth, {camera_(a), camera_(b)}, std::nullopt, Pen{lines.colour, lines.width_px}});
      }
    }
  }

  const MeshView& view_;
  const Camera& camera_;
  double size_ = 1.0;
  std::vector<Piece> pieces_;
};

std::vector<LegendEntry> legendEntries(const MeshView& view) {
  std::vector<LegendEntry> entries;
  for (const LegendColour& colour : view.legend) {
    entries.push_back({colour.name, Stroke::none, Marker::none, colour.colour, true, 0.0});
  }
  for (const Segments& lines : view.lines) {
    if (lines.name.empty()) continue;
    entries.push_back({lines.name, Stroke::solid, Marker::none, lines.colour, false, std::max(lines.width_px, 1.5)});
  }
  return entries;
}

// A bar of a round length near a fifth of the room, in its lower left corner.
void drawScaleBar(Canvas& canvas, const Rect& room, double pixels_per_mm) {
  const double length = niceStep(0.25 * room.width() / pixels_per_mm, 2);
  const Vec2 from(room.left, room.bottom - 0.5 * kLineHeight);
  const Vec2 to(room.left + length * pixels_per_mm, from.y());
  canvas.line(from, to, {kInk, 2.5});
  canvas.text({to.x() + kGap, to.y()}, fmt::format("{:g} mm", WrittenNumber{length}), {});
}

void drawColourKey(Canvas& canvas, const ColourKey& key, const Rect& bar) {
  const Range range{key.from, key.to};
  drawColourBar(canvas, bar, key.colours, range, niceTicks(range, Scale::linear, 8), withUnit(key.label, key.unit));
}

struct ViewLayout {
  Rect room;  // room for the surface
  Rect colour_bar{};
  double legend_top = 0.0;
};

ViewLayout computeLayout(const MeshView& view, const std::vector<LegendEntry>& legend, const Rect& panel,
                         const Canvas& canvas) {
  constexpr double kKeyWidth = 86.0;
  constexpr double kBarWidth = 14.0;
  ViewLayout layout{.room = panel};
  if (!view.title.empty()) layout.room.top += kTitleSize + 2.0 * kGap;
  const int rows = legendRows(canvas, legend, panel.width());
  layout.room.bottom -= rows * kLineHeight + kGap;
  layout.legend_top = layout.room.bottom + kGap;
  if (view.scale_bar) layout.room.bottom -= kLineHeight + kGap;
  if (view.colour_key) {
    layout.room.right -= kKeyWidth;
    layout.colour_bar = {layout.room.right + kGap, layout.room.top, layout.room.right + kGap + kBarWidth,
                         layout.room.bottom};
  }
  return layout;
}

void drawPlaces(Canvas& canvas, const MeshView& view, const Camera& camera, const Rect& bounds) {
  for (const Place3& place : view.places) drawMarker(canvas, camera(place.at), place.marker, place.colour, 3.5);
  for (const Place3& place : view.places) drawBeside(canvas, camera(place.at), place.text, place.colour, bounds);
}

}  // namespace

void drawMeshView(Canvas& canvas, const MeshView& view, const Rect& panel) {
  const std::vector<LegendEntry> legend = legendEntries(view);
  const ViewLayout layout = computeLayout(view, legend, panel, canvas);
  Camera camera(view);
  camera.fit(seenBox(view, camera), layout.room);
  canvas.text({0.5 * (panel.left + panel.right), panel.top}, view.title, kPanelTitle);
  canvas.beginPicture(layout.room);
  Scenery(view, camera).paint(canvas);
  canvas.endPicture();
  drawPlaces(canvas, view, camera, panel);
  if (view.scale_bar) {
    const Rect under{layout.room.left, layout.room.bottom, layout.room.right, layout.room.bottom + kLineHeight + kGap};
    drawScaleBar(canvas, under, camera.pixelsPerMm());
  }
  if (view.colour_key) drawColourKey(canvas, *view.colour_key, layout.colour_bar);
  drawLegend(canvas, legend, panel, layout.legend_top);
}

// Corners of a box are numbered by bits, one an axis: an edge changes one bit.

std::vector<std::array<Vec3, 2>> boxEdges(const Eigen::AlignedBox3d& box) {
  const auto corner = [&box](int i) { return box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i)); };
  std::vector<std::array<Vec3, 2>> edges;
  for (int i = 0; i < 8; ++i) {
    for (const int axis : {1, 2, 4}) {  // corners are numbered by bits: x, y, z
      if ((i & axis) == 0) edges.push_back({corner(i), corner(i | axis)});
    }
  }
  return edges;
}

}  // namespace palpate::figures
