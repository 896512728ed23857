// The whole drawing once, in mm from its upper left corner; each sheet of paper is a window of it.
//
// Written as text: an SVG whose size and coordinates are millimetres prints at true size.
#include "palpate/measure/stencil.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "palpate/base/error.h"
#include "palpate/base/number_range.h"

namespace palpate::measure {

namespace {

constexpr double kEdgeMm = 6.0;         ///< margin that printers leave white
constexpr double kWordsMm = 30.0;       ///< room for words below the holes
constexpr double kAboveMm = 16.0;       ///< room for the arrow
constexpr double kRulerMm = 16.0;       ///< room for the scale target
constexpr double kTileWidthMm = 190.0;  ///< part of A4 that a tile shows
constexpr double kTileHeightMm = 270.0;
constexpr double kCheckMm = 100.0;

struct Paper {
  StencilPage page;
  const char* name;
  double width_mm;
  double height_mm;
};
constexpr std::array kPapers = {Paper{StencilPage::a4, "a4", 210, 297}, Paper{StencilPage::a3, "a3", 297, 420},
                                Paper{StencilPage::a2, "a2", 420, 594}};

void require(const char* name, double value, const NumberRange& range, const char* unit) {
  if (!range.holds(value)) {
    throw Error(fmt::format("stencil: {} = {}", name, outOfRange(fmt::format("{:g}", value), range, unit)));
  }
}

void check(const StencilSettings& settings) {
  require("spacing", settings.spacing_mm, {5.0, 100.0}, "mm");
  require("columns", settings.columns, {2.0, 60.0}, "");
  require("rows", settings.rows, {2.0, 60.0}, "");
  require("hole", settings.hole_mm, {1.0, 0.5 * settings.spacing_mm}, "mm");
}

/// The drawing: where things lie, mm from the upper left corner.
class Drawing {
 public:
  explicit Drawing(const StencilSettings& settings) : settings_(settings) {
    const double margin = 0.5 * settings.hole_mm + kEdgeMm;
    const double holes_wide = settings.spacing_mm * (settings.columns - 1);
    width_mm = std::max(holes_wide + 2.0 * margin, kCheckMm + 2.0 * kEdgeMm);
    left_mm_ = 0.5 * (width_mm - holes_wide);
    bottom_mm_ = kAboveMm + margin + settings.spacing_mm * (settings.rows - 1);
    words_mm_ = bottom_mm_ + margin;
    height_mm = words_mm_ + kWordsMm + (settings.scale_target ? kRulerMm : 0.0);
  }

  std::string body() const {
    std::string svg;
    for (const Vec2& hole : stencilHoles(settings_)) svg += holeAt(hole);
    svg += numbers();
    for (const Vec2& mark : contactMarks(settings_)) svg += contactAt(mark);
    svg += arrow() + checkBar() + words();
    return settings_.scale_target ? svg + ruler() : svg;
  }

  double width_mm = 0.0;
  double height_mm = 0.0;

 private:
  Vec2 onPaper(const Vec2& skin) const { return {left_mm_ + skin.x(), bottom_mm_ - skin.y()}; }

  std::string holeAt(const Vec2& hole) const {
    const Vec2 at = onPaper(hole);
    const double arm = 0.5 * settings_.hole_mm + 2.0;
    return fmt::format(
        "<circle class=\"hole\" cx=\"{0:g}\" cy=\"{1:g}\" r=\"{2:g}\"/>"
        "<path class=\"thin\" d=\"M{3:g} {1:g}H{4:g}M{0:g} {5:g}V{6:g}\"/>\n",
        at.x(), at.y(), 0.5 * settings_.hole_mm, at.x() - arm, at.x() + arm, at.y() - arm, at.y() + arm);
  }

  /// Columns by number below, rows by number on the left, to check a list of clicked dots with.
  std::string numbers() const {
    std::string svg;
    const double off = 0.5 * settings_.hole_mm + 1.2;
    for (int column = 0; column < settings_.columns; ++column) {
      for (int row = 0; row < settings_.rows; ++row) {
        const Vec2 at = onPaper(settings_.spacing_mm * Vec2(column, row));
        svg += fmt::format("<text class=\"tiny\" x=\"{:g}\" y=\"{:g}\">{},{}</text>\n", at.x() + 0.6 * off,
                           at.y() + off + 1.0, column + 1, row + 1);
      }
    }
    return svg;
  }

  std::string contactAt(const Vec2& mark) const {
    const Vec2 at = onPaper(mark);
    return fmt::format(
        "<circle class=\"contact\" cx=\"{0:g}\" cy=\"{1:g}\" r=\"2\"/>"
        "<path class=\"contact\" d=\"M{2:g} {3:g}L{4:g} {5:g}M{2:g} {5:g}L{4:g} {3:g}\"/>\n",
        at.x(), at.y(), at.x() - 4.0, at.y() - 4.0, at.x() + 4.0, at.y() + 4.0);
  }

  std::string arrow() const {
    const double x = 0.5 * width_mm;
    return fmt::format(
        "<path class=\"bold\" d=\"M{0:g} 14V3M{1:g} 7L{0:g} 3L{2:g} 7\"/>"
        "<text x=\"{3:g}\" y=\"8\">towards the head</text>\n",
        x, x - 2.5, x + 2.5, x + 5.0);
  }

  std::string checkBar() const {
    const double x = kEdgeMm;
    const double y = words_mm_ + 4.0;
    return fmt::format(
        "<path class=\"bold\" id=\"check\" d=\"M{0:g} {1:g}H{2:g}M{0:g} {3:g}V{4:g}M{2:g} {3:g}V{4:g}\"/>"
        "<text x=\"{0:g}\" y=\"{5:g}\">this bar is 100 mm: if it is not, print again at 100 %, without "
        "\"fit to page\"</text>\n",
        x, y, x + kCheckMm, y - 2.0, y + 2.0, y + 6.5);
  }

  std::string words() const {
    const double y = words_mm_ + 15.5;
    return fmt::format(
        "<text x=\"{0:g}\" y=\"{1:g}\">{2} x {3} holes of {4:g} mm, {5:g} mm apart. Punch the circles in a flexible "
        "sheet.</text>\n"
        "<text x=\"{0:g}\" y=\"{6:g}\">Dots: one washable pen, red or blue. Contact (crosses): another colour.</text>\n"
        "<text x=\"{0:g}\" y=\"{7:g}\">At least two rows of dots beyond what moves.</text>\n",
        kEdgeMm, y, settings_.columns, settings_.rows, settings_.hole_mm, settings_.spacing_mm, y + 4.8, y + 9.6);
  }

  /// Bars of 10 mm, black and white.
  std::string ruler() const {
    const double y = words_mm_ + kWordsMm + 1.0;
    std::string svg = fmt::format(
        "<rect class=\"thin\" id=\"ruler\" x=\"{:g}\" y=\"{:g}\" width=\"100\" "
        "height=\"8\"/>\n",
        kEdgeMm, y);
    for (int bar = 0; bar < 10; bar += 2) {
      svg += fmt::format("<rect x=\"{:g}\" y=\"{:g}\" width=\"10\" height=\"8\"/>\n", kEdgeMm + 10.0 * bar, y);
    }
    return svg + fmt::format(
                     "<text x=\"{:g}\" y=\"{:g}\">scale: cut out and tape flat onto the skin beside the "
                     "dots, 10 mm a bar</text>\n",
                     kEdgeMm, y + 12.5);
  }

  const StencilSettings& settings_;
  double left_mm_ = 0.0;    // left edge of the first column
  double bottom_mm_ = 0.0;  // lower edge of the lowest row, from above
  double words_mm_ = 0.0;
};

constexpr const char* kStyle =
    "<style>\n"
    "path, circle { fill: none; stroke: #000; stroke-width: 0.25; }\n"
    "text { font: 3.4px sans-serif; fill: #000; }\n"
    ".tiny { font-size: 2.2px; fill: #777; }\n"
    ".thin { fill: none; stroke: #000; stroke-width: 0.12; }\n"
    ".bold { stroke-width: 0.6; }\n"
    ".contact { stroke: #a00; stroke-width: 0.35; stroke-dasharray: 1.2 0.6; }\n"
    "</style>\n";

/// A sheet that shows the drawing from `corner` on, itself `inset` from the paper's corner.
std::string sheet(const Vec2& paper_mm, const Vec2& corner, const Vec2& shown, const Vec2& inset,
                  const std::string& body, const std::string& marks) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}mm\" height=\"{1:g}mm\" viewBox=\"0 0 {0:g} {1:g}\">\n"
      "<title>Stencil for dots on the skin</title>\n{2}"
      "<rect width=\"{0:g}\" height=\"{1:g}\" fill=\"#fff\"/>\n"
      "<svg x=\"{3:g}\" y=\"{4:g}\" width=\"{5:g}\" height=\"{6:g}\" viewBox=\"{7:g} {8:g} {5:g} {6:g}\">\n{9}</svg>\n"
      "{10}</svg>\n",
      paper_mm.x(), paper_mm.y(), kStyle, inset.x(), inset.y(), shown.x(), shown.y(), corner.x(), corner.y(), body,
      marks);
}

/// Crosses at the corners of a tile's part, and its name.
std::string tileMarks(const Vec2& inset, const Vec2& shown, int row, int column) {
  std::string marks;
  for (const double x : {inset.x(), inset.x() + shown.x()}) {
    for (const double y : {inset.y(), inset.y() + shown.y()}) {
      marks += fmt::format("<path class=\"thin\" d=\"M{:g} {:g}h8M{:g} {:g}v8\"/>\n", x - 4.0, y, x, y - 4.0);
    }
  }
  return marks + fmt::format(
                     "<text class=\"tiny\" x=\"{:g}\" y=\"5\">row {}, column {}: cut along the crosses and "
                     "glue them on each other</text>\n",
                     inset.x() + 6.0, row, column);
}

std::vector<StencilSheet> tiles(const Drawing& drawing, const std::string& body) {
  const Paper& paper = kPapers.front();
  const Vec2 shown(kTileWidthMm, kTileHeightMm);
  const Vec2 inset = 0.5 * (Vec2(paper.width_mm, paper.height_mm) - shown);
  std::vector<StencilSheet> sheets;
  const int rows = static_cast<int>(std::ceil(drawing.height_mm / kTileHeightMm));
  const int columns = static_cast<int>(std::ceil(drawing.width_mm / kTileWidthMm));
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const Vec2 corner(column * kTileWidthMm, row * kTileHeightMm);
      sheets.push_back(
          {fmt::format("r{}c{}", row + 1, column + 1), sheet({paper.width_mm, paper.height_mm}, corner, shown, inset,
                                                             body, tileMarks(inset, shown, row + 1, column + 1))});
    }
  }
  return sheets;
}

bool holds(const Paper& paper, const Drawing& drawing) {
  return drawing.width_mm <= paper.width_mm && drawing.height_mm <= paper.height_mm;
}

}  // namespace

std::vector<Vec2> stencilHoles(const StencilSettings& settings) {
  std::vector<Vec2> holes;
  for (int row = 0; row < settings.rows; ++row) {
    for (int column = 0; column < settings.columns; ++column) {
      holes.emplace_back(settings.spacing_mm * column, settings.spacing_mm * row);
    }
  }
  return holes;
}

std::vector<Vec2> contactMarks(const StencilSettings& settings) {
  const int column = (settings.columns - 2) / 2;
  const int row = (settings.rows - 2) / 2;
  const Vec2 middle = settings.spacing_mm * Vec2(column + 0.5, row + 0.5);
  std::vector<Vec2> marks = {middle};
  constexpr int kApart = 3;  // meshes
  constexpr int kRowsForMore = 11;
  if (settings.rows < kRowsForMore) return marks;
  marks.emplace_back(middle + Vec2(0.0, kApart * settings.spacing_mm));
  marks.emplace_back(middle - Vec2(0.0, kApart * settings.spacing_mm));
  return marks;
}

std::vector<StencilSheet> stencilSheets(const StencilSettings& settings) {
  check(settings);
  const Drawing drawing(settings);
  const std::string body = drawing.body();
  if (settings.page == StencilPage::tiled_a4) return tiles(drawing, body);
  const auto fits = [&](const Paper& paper) { return holds(paper, drawing); };
  const auto smallest = std::ranges::find_if(kPapers, fits);
  if (settings.page == StencilPage::fitting && smallest == kPapers.end()) return tiles(drawing, body);
  const auto asked =
      settings.page == StencilPage::fitting ? smallest : std::ranges::find(kPapers, settings.page, &Paper::page);
  if (!fits(*asked)) {
    throw Error(fmt::format("stencil: {} x {} holes need {:.0f} x {:.0f} mm, {} has {:g} x {:g}; use {} or fewer holes",
                            settings.columns, settings.rows, drawing.width_mm, drawing.height_mm, asked->name,
                            asked->width_mm, asked->height_mm,
                            smallest == kPapers.end() ? "tiled-a4" : fmt::format("{}, tiled-a4", smallest->name)));
  }
  const Vec2 paper(asked->width_mm, asked->height_mm);
  const Vec2 size(drawing.width_mm, drawing.height_mm);
  return {{"", sheet(paper, Vec2::Zero(), size, 0.5 * (paper - size), body, "")}};
}

}  // namespace palpate::measure
