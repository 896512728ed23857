// Lays panels, titles and the note out first, because the note's lines are wrapped by measuring, then draws once on the
// requested sheet: PNG, SVG, or one whose texts a test reads.
#include "report/charts/figure.h"

#include <cmath>
#include <sstream>

#include "palpate/base/error.h"
#include "palpate/base/output_file.h"
#include "report/charts/canvas.h"
#include "report/charts/drawing.h"
#include "report/charts/lettering.h"
#include "report/charts/picture_file.h"

namespace palpate::figures {

namespace {

constexpr double kMargin = 12.0;
constexpr double kBetweenPanels = 18.0;
constexpr TextStyle kFigureTitle{.size_px = 15.0, .bold = true, .across = Align::middle, .down = Align::start};
constexpr TextStyle kNote{.size_px = 11.0, .down = Align::start};

// The text in lines no wider than the width; wider words get lines of their own.
std::vector<std::string> wrapped(const Canvas& canvas, const std::string& text, double width) {
  std::vector<std::string> lines;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (!lines.empty()) {
      const std::string longer = lines.back() + " " + word;
      if (canvas.textBox({0.0, 0.0}, longer, kNote).width() <= width) {
        lines.back() = longer;
        continue;
      }
    }
    lines.push_back(word);
  }
  return lines;
}

struct FigureLayout {
  double width = 0.0;
  double height = 0.0;
  double panels_top = 0.0;
  double note_top = 0.0;
  std::vector<std::string> note;
};

FigureLayout computeLayout(const Figure& figure) {
  const int panels = static_cast<int>(figure.panels.size());
  const int columns = std::max(1, std::min(figure.columns, panels));
  const int rows = (panels + columns - 1) / columns;
  FigureLayout layout;
  layout.width = 2.0 * kMargin + columns * figure.panel_width_px + (columns - 1) * kBetweenPanels;
  layout.panels_top = kMargin + (figure.title.empty() ? 0.0 : kFigureTitle.size_px + kMargin);
  layout.note_top = layout.panels_top + rows * (figure.panel_height_px + kBetweenPanels) - kBetweenPanels + kMargin;
  const Canvas measure = Canvas::png(1.0, 1.0, 1.0);
  layout.note = wrapped(measure, figure.note, layout.width - 2.0 * kMargin);
  layout.height = layout.note_top + static_cast<double>(layout.note.size()) * 1.35 * kNote.size_px +
                  (layout.note.empty() ? 0.0 : kMargin);
  return layout;
}

Rect panelPlace(const Figure& figure, const FigureLayout& layout, int index) {
  const int column = index % std::max(1, figure.columns);
  const int row = index / std::max(1, figure.columns);
  const double left = kMargin + column * (figure.panel_width_px + kBetweenPanels);
  const double top = layout.panels_top + row * (figure.panel_height_px + kBetweenPanels);
  return {left, top, left + figure.panel_width_px, top + figure.panel_height_px};
}

void draw(Canvas& canvas, const Plot& plot, const Rect& place) { drawPlot(canvas, plot, place); }
void draw(Canvas& canvas, const MeshView& view, const Rect& place) { drawMeshView(canvas, view, place); }

void draw(Canvas& canvas, const Figure& figure, const FigureLayout& layout) {
  canvas.text({0.5 * layout.width, kMargin}, figure.title, kFigureTitle);
  int index = 0;
  for (const Panel& panel : figure.panels) {
    const Rect place = panelPlace(figure, layout, index++);
    std::visit([&](const auto& content) { draw(canvas, content, place); }, panel);
  }
  double top = layout.note_top;
  for (const std::string& line : layout.note) {
    canvas.text({kMargin, top}, line, kNote);
    top += 1.35 * kNote.size_px;
  }
}

void save(const std::string& bytes, const std::filesystem::path& file) {
  OutputFile output(file);
  output.write(bytes);
  output.commit();
}

}  // namespace

std::string renderPng(const Figure& figure, double scale) {
  const FigureLayout layout = computeLayout(figure);
  Canvas canvas = Canvas::png(layout.width, layout.height, scale);
  draw(canvas, figure, layout);
  return canvas.finish();
}

std::string renderSvg(const Figure& figure) {
  const FigureLayout layout = computeLayout(figure);
  Canvas canvas = Canvas::svg(layout.width, layout.height);
  draw(canvas, figure, layout);
  return canvas.finish();
}

void writePng(const Figure& figure, const std::filesystem::path& file, double scale) {
  save(renderPng(figure, scale), file);
}

void writeSvg(const Figure& figure, const std::filesystem::path& file) { save(renderSvg(figure), file); }

std::vector<DrawnText> collectDrawnTexts(const Figure& figure) {
  const FigureLayout layout = computeLayout(figure);
  Canvas canvas = Canvas::png(layout.width, layout.height, 1.0);
  draw(canvas, figure, layout);
  return canvas.texts();
}

}  // namespace palpate::figures

namespace palpate::app {

void checkPictureName(const std::filesystem::path& file) {
  const std::string extension = file.extension().string();
  if (extension != ".png" && extension != ".svg")
    throw Error::inFile(file.string(), "a plot's name must end in .png or .svg");
}

void writePicture(const figures::Figure& figure, const std::filesystem::path& file, double png_scale) {
  checkPictureName(file);
  file.extension() == ".svg" ? figures::writeSvg(figure, file) : figures::writePng(figure, file, png_scale);
}

}  // namespace palpate::app
