#include "cli/render/contact_sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "cli/render/picture_series.h"
#include "palpate/view/scene_view.h"

namespace palpate::app {

namespace {

constexpr view::PictureSize kTile{480, 360, 2};
constexpr int kColumns = 3;
/// Zoom of the pictures around the fingers, against the whole body.
constexpr double kCloser = 2.4;

/// One picture of the sheet.
struct Tile {
  const servo::TickSamples* frame;
  view::PictureSettings settings;
};

double frameTime(const scene::World& world, const servo::TickSamples& frame) {
  return static_cast<double>(frame.front().tick) / world.scene.ticks_per_s;
}

/// The middle of the fingers that touch.
std::optional<Vec3> contactCentre(const servo::TickSamples& frame) {
  Vec3 sum = Vec3::Zero();
  int count = 0;
  for (const trace::Sample& sample : frame) {
    if (sample.contact.touch == contact::Touch::free) continue;
    sum += sample.contact.proxy;
    ++count;
  }
  return count == 0 ? std::nullopt : std::optional<Vec3>(sum / count);
}

view::PictureSettings settingsFor(const scene::World& world, const servo::TickSamples& frame,
                                  const std::string& title) {
  scene::ViewSettings view = world.scene.view;
  view.stereo = scene::StereoMode::mono;
  view.show.clear();
  view.colours = scene::Colouring::plain;
  if (!frame.empty() && !view.look_at_mm) {
    view.look_at_mm = contactCentre(frame);
    view.zoom *= kCloser;
  }
  view::PictureSettings settings = view::pictureSettings(world, view, static_cast<double>(kTile.width) / kTile.height);
  settings.labels.title = frame.empty() ? title : fmt::format("{}, {:.2f} s", title, frameTime(world, frame));
  settings.labels.finger_names = fingerNames(world);
  return settings;
}

std::vector<Tile> makeTiles(const scene::World& world, const SheetMoments& moments) {
  static const servo::TickSamples nobody;
  std::vector<Tile> tiles;
  const auto add = [&](const servo::TickSamples& frame, const std::string& title,
                       const std::function<void(view::Look&)>& change) {
    tiles.push_back({&frame, settingsFor(world, frame, title)});
    change(tiles.back().settings.look);
  };
  add(nobody, "at rest", [](view::Look&) {});
  if (moments.pressed.empty()) return tiles;
  const servo::TickSamples& dragged = moments.dragged.empty() ? moments.pressed : moments.dragged;
  add(moments.pressed, "pressed deepest", [](view::Look&) {});
  add(dragged, "dragged farthest", [](view::Look& look) { look.show(view::Overlay::contact); });
  add(dragged, "strain", [](view::Look& look) { look.colouring = view::Colouring::strain; });
  add(moments.pressed, "haptic triangles", [](view::Look& look) {
    look.show(view::Overlay::haptic_triangles);
    look.show(view::Overlay::detecting_box);
  });
  add(moments.pressed, "cross-section", [](view::Look& look) { look.show(view::Overlay::section); });
  return tiles;
}

void paste(const view::Image& tile, int column, int row, view::Image& sheet) {
  for (int y = 0; y < tile.height; ++y) {
    const view::Pixel* from = &tile.at(0, y);
    std::copy(from, from + tile.width, &sheet.at(column * kTile.width, row * kTile.height + y));
  }
}

}  // namespace

view::Image contactSheet(const std::shared_ptr<const scene::World>& world, const SheetMoments& moments,
                         const Progress& progress) {
  const std::vector<Tile> tiles = makeTiles(*world, moments);
  const int count = static_cast<int>(tiles.size());
  view::Image sheet(std::min(kColumns, count) * kTile.width, (count + kColumns - 1) / kColumns * kTile.height);
  PictureSeries series(world, kTile);
  for (int i = 0; i < count; ++i) {
    report(progress, "drawing", static_cast<double>(i) / count);
    const Tile& tile = tiles[static_cast<std::size_t>(i)];
    const double time_s = tile.frame->empty() ? 0.0 : frameTime(*world, *tile.frame);
    paste(series.capture(*tile.frame, time_s, tile.settings).image, i % kColumns, i / kColumns, sheet);
  }
  return sheet;
}

}  // namespace palpate::app
