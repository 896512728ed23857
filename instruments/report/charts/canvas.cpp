// The sheet on cairo: image surfaces for PNG, SVG surfaces for SVG, one path through both.
#include "report/charts/canvas.h"

#include <cairo-svg.h>
#include <cairo.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "palpate/base/error.h"
#include "palpate/base/text.h"

namespace palpate::figures {

namespace {

constexpr const char* kFont = "DejaVu Sans";
// Pixels a CSS pixel inside a picture of an SVG.
constexpr double kPictureScale = 2.0;

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void check(cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) throw Error(std::string("drawing failed: ") + cairo_status_to_string(status));
}

struct DestroyContext {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
struct DestroySurface {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
using Context = std::unique_ptr<cairo_t, DestroyContext>;
using Surface = std::unique_ptr<cairo_surface_t, DestroySurface>;

// Unhinted glyphs, measured alike on every surface: the layout of the PNG and the SVG is the same.
Context contextOn(cairo_surface_t* surface) {
  Context context(cairo_create(surface));
  check(cairo_status(context.get()));
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_set_font_options(context.get(), options);
  cairo_font_options_destroy(options);
  cairo_set_line_join(context.get(), CAIRO_LINE_JOIN_ROUND);
  return context;
}

void setColour(cairo_t* context, const Colour& colour) {
  cairo_set_source_rgba(context, colour.red, colour.green, colour.blue, colour.alpha);
}

void setPen(cairo_t* context, const Pen& pen) {
  constexpr std::array kDashes{6.0, 4.0};
  constexpr std::array kDots{1.5, 3.0};
  setColour(context, pen.colour);
  cairo_set_line_width(context, pen.width_px);
  cairo_set_dash(context, nullptr, 0, 0.0);
  if (pen.stroke == Stroke::dashed) cairo_set_dash(context, kDashes.data(), 2, 0.0);
  if (pen.stroke == Stroke::dotted) cairo_set_dash(context, kDots.data(), 2, 0.0);
}

void paintPath(cairo_t* context, const std::optional<Pen>& pen, const std::optional<Colour>& fill) {
  if (fill) {
    setColour(context, *fill);
    cairo_fill_preserve(context);
  }
  if (pen && pen->stroke != Stroke::none) {
    setPen(context, *pen);
    cairo_stroke_preserve(context);
  }
  cairo_new_path(context);
}

void setFont(cairo_t* context, const TextStyle& style) {
  cairo_select_font_face(context, kFont, CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, style.size_px);
}

double shareBefore(Align align) { return align == Align::start ? 0.0 : align == Align::middle ? 0.5 : 1.0; }

// Above and below the base line, in shares of the size: the same for every text, so that neighbours share one line.
constexpr double kAscent = 0.76;
constexpr double kDescent = 0.24;

}  // namespace

struct Canvas::Impl {
  bool is_png = false;
  double width = 0.0;
  double height = 0.0;
  std::string bytes;  // the SVG, while it is written
  Surface surface;
  Context context;
  Surface picture;  // where a picture is being painted
  Context outer;    // the sheet, meanwhile
  Rect picture_place;
  std::vector<DrawnText> texts;
};

Canvas::Canvas(std::unique_ptr<Impl> sheet) : impl_(std::move(sheet)) {
  impl_->context = contextOn(impl_->surface.get());
}
Canvas::~Canvas() = default;
Canvas::Canvas(Canvas&&) noexcept = default;
Canvas& Canvas::operator=(Canvas&&) noexcept = default;

Canvas Canvas::png(double width_px, double height_px, double scale) {
  auto sheet = std::make_unique<Impl>();
  sheet->is_png = true;
  sheet->width = width_px;
  sheet->height = height_px;
  sheet->surface.reset(cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(std::lround(width_px * scale)),
                                                  static_cast<int>(std::lround(height_px * scale))));
  check(cairo_surface_status(sheet->surface.get()));
  Canvas canvas(std::move(sheet));
  cairo_scale(canvas.impl_->context.get(), scale, scale);
  canvas.rectangle({0.0, 0.0, width_px, height_px}, std::nullopt, kPaper);
  return canvas;
}

Canvas Canvas::svg(double width_px, double height_px) {
  auto sheet = std::make_unique<Impl>();
  sheet->width = width_px;
  sheet->height = height_px;
  sheet->surface.reset(cairo_svg_surface_create_for_stream(append, &sheet->bytes, width_px, height_px));
  check(cairo_surface_status(sheet->surface.get()));
  cairo_svg_surface_set_document_unit(sheet->surface.get(), CAIRO_SVG_UNIT_PX);
  Canvas canvas(std::move(sheet));
  canvas.rectangle({0.0, 0.0, width_px, height_px}, std::nullopt, kPaper);
  return canvas;
}

void Canvas::path(std::span<const Vec2> points, bool closed, const std::optional<Pen>& pen,
                  const std::optional<Colour>& fill) {
  if (points.empty()) return;
  cairo_t* context = impl_->context.get();
  cairo_new_path(context);
  for (const Vec2& point : points) cairo_line_to(context, point.x(), point.y());
  if (closed) cairo_close_path(context);
  paintPath(context, pen, fill);
}

void Canvas::line(const Vec2& from, const Vec2& to, const Pen& pen) {
  const std::array points{from, to};
  path(points, false, pen);
}

void Canvas::rectangle(const Rect& rect, const std::optional<Pen>& pen, const std::optional<Colour>& fill) {
  cairo_rectangle(impl_->context.get(), rect.left, rect.top, rect.width(), rect.height());
  paintPath(impl_->context.get(), pen, fill);
}

void Canvas::disc(const Vec2& centre, double radius, const std::optional<Pen>& pen, const std::optional<Colour>& fill) {
  cairo_new_path(impl_->context.get());
  cairo_arc(impl_->context.get(), centre.x(), centre.y(), radius, 0.0, 2.0 * std::numbers::pi);
  paintPath(impl_->context.get(), pen, fill);
}

void Canvas::image(const Rect& place, int columns, int rows, const std::vector<std::uint32_t>& pixels) {
  const Surface image(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, columns, rows));
  check(cairo_surface_status(image.get()));
  const int stride = cairo_image_surface_get_stride(image.get()) / static_cast<int>(sizeof(std::uint32_t));
  auto* target = reinterpret_cast<std::uint32_t*>(cairo_image_surface_get_data(image.get()));
  for (int row = 0; row < rows; ++row) {
    std::copy_n(pixels.begin() + static_cast<std::ptrdiff_t>(row) * columns, columns,
                target + static_cast<std::ptrdiff_t>(row) * stride);
  }
  cairo_surface_mark_dirty(image.get());
  cairo_t* context = impl_->context.get();
  cairo_save(context);
  cairo_translate(context, place.left, place.top);
  cairo_scale(context, place.width() / columns, place.height() / rows);
  cairo_set_source_surface(context, image.get(), 0.0, 0.0);
  cairo_pattern_set_filter(cairo_get_source(context), CAIRO_FILTER_NEAREST);
  cairo_paint(context);
  cairo_restore(context);
}

Rect Canvas::textBox(const Vec2& at, const std::string& text, const TextStyle& style) const {
  setFont(impl_->context.get(), style);
  cairo_text_extents_t extents;
  cairo_text_extents(impl_->context.get(), wellFormed(text).c_str(), &extents);
  const double width = extents.x_advance;
  const double height = (kAscent + kDescent) * style.size_px;
  if (style.upwards) {  // "across" runs upwards, "down" runs to the right
    const double left = at.x() - shareBefore(style.down) * height;
    const double bottom = at.y() + shareBefore(style.across) * width;
    return {left, bottom - width, left + height, bottom};
  }
  const double left = at.x() - shareBefore(style.across) * width;
  const double top = at.y() - shareBefore(style.down) * height;
  return {left, top, left + width, top + height};
}

void Canvas::text(const Vec2& at, const std::string& any_bytes, const TextStyle& style) {
  if (any_bytes.empty()) return;
  const std::string text = wellFormed(any_bytes);  // cairo draws nothing any more after one byte that is of no letter
  const Rect box = textBox(at, text, style);
  impl_->texts.push_back({text, box.left, box.top, box.right, box.bottom});
  cairo_t* context = impl_->context.get();
  cairo_save(context);
  if (style.upwards) {
    cairo_translate(context, box.left + kAscent * style.size_px, box.bottom);
    cairo_rotate(context, -0.5 * std::numbers::pi);
  } else {
    cairo_translate(context, box.left, box.top + kAscent * style.size_px);
  }
  cairo_move_to(context, 0.0, 0.0);
  if (style.halo) {
    cairo_text_path(context, text.c_str());
    setPen(context, {kPaper, 0.28 * style.size_px});
    cairo_stroke(context);
    cairo_move_to(context, 0.0, 0.0);
  }
  setColour(context, style.colour);
  cairo_show_text(context, text.c_str());
  cairo_restore(context);
}

const std::vector<DrawnText>& Canvas::texts() const { return impl_->texts; }

void Canvas::beginClip(const Rect& rect) {
  cairo_save(impl_->context.get());
  cairo_rectangle(impl_->context.get(), rect.left, rect.top, rect.width(), rect.height());
  cairo_clip(impl_->context.get());
}

void Canvas::endClip() { cairo_restore(impl_->context.get()); }

void Canvas::beginPicture(const Rect& rect) {
  impl_->picture_place = rect;
  impl_->picture.reset(cairo_image_surface_create(CAIRO_FORMAT_ARGB32,
                                                  static_cast<int>(std::ceil(rect.width() * kPictureScale)),
                                                  static_cast<int>(std::ceil(rect.height() * kPictureScale))));
  check(cairo_surface_status(impl_->picture.get()));
  impl_->outer = std::exchange(impl_->context, contextOn(impl_->picture.get()));
  cairo_scale(impl_->context.get(), kPictureScale, kPictureScale);
  cairo_translate(impl_->context.get(), -rect.left, -rect.top);
}

void Canvas::endPicture() {
  impl_->context = std::move(impl_->outer);
  cairo_t* context = impl_->context.get();
  cairo_save(context);
  cairo_translate(context, impl_->picture_place.left, impl_->picture_place.top);
  cairo_scale(context, 1.0 / kPictureScale, 1.0 / kPictureScale);
  cairo_set_source_surface(context, impl_->picture.get(), 0.0, 0.0);
  cairo_paint(context);
  cairo_restore(context);
  impl_->picture.reset();
}

std::string Canvas::finish() {
  check(cairo_status(impl_->context.get()));
  std::string bytes;
  if (impl_->is_png) {
    check(cairo_surface_write_to_png_stream(impl_->surface.get(), append, &bytes));
    return bytes;
  }
  impl_->context.reset();
  cairo_surface_finish(impl_->surface.get());
  check(cairo_surface_status(impl_->surface.get()));
  impl_->surface.reset();
  return tidiedSvg(impl_->bytes, impl_->texts);
}

void drawMarker(Canvas& canvas, const Vec2& at, Marker marker, const Colour& colour, double size_px) {
  const auto corner = [&](double x, double y) { return Vec2(at.x() + x * size_px, at.y() + y * size_px); };
  const auto filled = [&](std::initializer_list<Vec2> corners) {
    canvas.path(std::vector<Vec2>(corners), true, std::nullopt, colour);
  };
  switch (marker) {
    case Marker::none:
      return;
    case Marker::circle:
      return canvas.disc(at, size_px * 0.95, std::nullopt, colour);
    case Marker::square:
      return filled({corner(-0.85, -0.85), corner(0.85, -0.85), corner(0.85, 0.85), corner(-0.85, 0.85)});
    case Marker::triangle:
      return filled({corner(0.0, -1.1), corner(1.05, 0.8), corner(-1.05, 0.8)});
    case Marker::diamond:
      return filled({corner(0.0, -1.2), corner(1.2, 0.0), corner(0.0, 1.2), corner(-1.2, 0.0)});
    case Marker::cross:
      canvas.line(corner(-0.9, -0.9), corner(0.9, 0.9), {colour, 1.6});
      canvas.line(corner(-0.9, 0.9), corner(0.9, -0.9), {colour, 1.6});
  }
}

std::uint32_t toPremultipliedArgb(const Colour& colour) {
  const auto byte = [](double share) { return static_cast<std::uint32_t>(std::lround(255.0 * share)); };
  return byte(colour.alpha) << 24 | byte(colour.red * colour.alpha) << 16 | byte(colour.green * colour.alpha) << 8 |
         byte(colour.blue * colour.alpha);
}

}  // namespace palpate::figures
