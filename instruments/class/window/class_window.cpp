#include "class/window/class_window.h"

#include <fmt/format.h>
#include <imgui.h>

#include "palpate/base/language.h"
#include "palpate/base/stopwatch.h"
#include "palpate/engine/living_skin.h"
#include "palpate/training/site.h"
#include "palpate/view/painter.h"
#include "palpate/view/scene_view.h"
#include "palpate/window/gui.h"
#include "palpate/window/window.h"

namespace palpate::viewer {

namespace {

constexpr int kBackPixels = 900;
constexpr double kBackAspect = 0.8;
constexpr float kOpenedWidth = 460.0f;
constexpr float kCurveHeight = 170.0f;
constexpr double kFrameS = 0.05;  // 20 pictures a second: live data come ten times

/// With the shoulders, where a lost finger may go.
Eigen::AlignedBox3d boxAround(const training::SiteSet& sites) {
  constexpr double kAroundMm = 45.0;
  Eigen::AlignedBox3d box;
  for (const training::Site& site : sites.sites) {
    box.extend(Vec3(site.point_mm - Vec3::Constant(kAroundMm)));
    box.extend(Vec3(site.point_mm + Vec3::Constant(kAroundMm)));
  }
  return box;
}

/// The back at rest, painted once; fingers are drawn over it.
class BackPainting {
 public:
  explicit BackPainting(const std::shared_ptr<const scene::World>& world)
      : target_(static_cast<int>(kBackPixels * kBackAspect), kBackPixels) {
    if (!world) return;
    const training::SiteSet sites = training::twelveSites(world->body->anatomy.landmarks);
    view::PictureSettings settings = view::pictureSettings(*world, kBackAspect);
    settings.camera = view::fitted(boxAround(sites), kBackAspect);
    settings.look.overlays.reset();
    const engine::LivingSkin skin(*world);
    view::Painter painter(world);
    painter.renderer().update(skin.surface());
    view::Canvas canvas;
    canvas.framebuffer = target_.framebuffer();
    canvas.width = target_.width();
    canvas.height = target_.height();
    target_.bind();
    const view::Painted painted = painter.paint({}, skin.surface(), settings, canvas);
    const view::Frustum frustum = view::makeFrustum(painted.eyes.screen, painted.eyes.middle, 1.0, 1e6);
    picture_.texture = target_.texture();
    picture_.aspect = kBackAspect;
    picture_.seen_at = [frustum](const Vec3& place) -> std::optional<Vec2> { return view::seenAt(frustum, place); };
    for (const training::Site& site : sites.sites) {
      picture_.sites.push_back(view::seenAt(frustum, site.point_mm));
    }
  }
  const BackPicture& picture() const { return picture_; }

 private:
  view::Target target_;
  BackPicture picture_;
};

void topRow(const classroom::ClassWatch& watch, const std::vector<classroom::Tile>& tiles) {
  std::size_t online = 0;
  std::size_t needing = 0;
  for (const auto& tile : tiles) {
    online += tile.online ? 1U : 0U;
    needing += tile.need != classroom::Need::none ? 1U : 0U;
  }
  const std::string stations =
      trnf("{} of {} station online", "{} of {} stations online", tiles.size(), online, tiles.size());
  const std::string help = trnf("{} needs help", "{} need help", needing, needing);
  ImGui::TextUnformatted(fmt::format("{}, {}", stations, help).c_str());
  if (watch.connected()) return;
  ImGui::SameLine();
  ImGui::TextDisabled("- %s", watch.trouble().c_str());
}

std::string commandOutcome(const classroom::Command& command, bool sent) {
  if (!sent) return tr("could not be sent");
  switch (command.kind) {
    case classroom::CommandKind::pause:
      return tr("asked to pause");
    case classroom::CommandKind::go_on:
      return tr("asked to continue");
    case classroom::CommandKind::message:
      return tr("sent");
    case classroom::CommandKind::next_block:
      break;
  }
  return tr("asked for the next block");
}

void rightColumn(classroom::ClassWatch& watch, const BackPicture& back, ClassView& view) {
  const auto tile = watch.tile(view.opened);
  const float room = ImGui::GetContentRegionAvail().y - kCurveHeight;
  if (ImGui::BeginChild("opened", {0.0f, std::max(100.0f, room)})) {
    if (tile) {
      const std::vector<classroom::ForcePoint> forces = watch.forces(view.opened);
      if (const auto command = openedStation({*tile, forces, back}, view)) {
        view.told = commandOutcome(*command, watch.ask(view.opened, *command));
      }
    } else {
      ImGui::TextDisabled("%s", tr("Choose a station to see its hand."));
    }
  }
  ImGui::EndChild();
  if (ImGui::BeginChild("curve")) classCurve(watch.learningCurve());
  ImGui::EndChild();
}

void classFrame(classroom::ClassWatch& watch, const BackPicture& back, const Vec2& size, ClassView& view) {
  const std::vector<classroom::Tile> tiles = watch.tiles();
  ImGui::SetNextWindowPos({0.0f, 0.0f});
  ImGui::SetNextWindowSize({static_cast<float>(size.x()), static_cast<float>(size.y())});
  constexpr auto kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                          ImGuiWindowFlags_NoBringToFrontOnFocus;
  if (ImGui::Begin("class", nullptr, kFlags)) {
    topRow(watch, tiles);
    const float width = ImGui::GetContentRegionAvail().x - kOpenedWidth;
    const Vec2 room(width - ImGui::GetStyle().ScrollbarSize, ImGui::GetContentRegionAvail().y);
    if (ImGui::BeginChild("tiles", {width, 0.0f})) {
      if (const auto clicked = classTiles(tiles, view, room)) {
        view.opened = *clicked == view.opened ? std::string() : *clicked;
        view.told.clear();
      }
      if (tiles.empty()) ImGui::TextDisabled("%s", tr("No station has connected yet."));
    }
    ImGui::EndChild();
    ImGui::SameLine();
    if (ImGui::BeginChild("right")) rightColumn(watch, back, view);
    ImGui::EndChild();
  }
  ImGui::End();
}

}  // namespace

void runClassWindow(classroom::ClassWatch& watch, const ClassWindowSettings& settings) {
  window::WindowSettings wanted;
  wanted.title = settings.title;
  wanted.width = settings.width;
  wanted.height = settings.height;
  window::Window window(wanted);
  window::Gui gui;
  const BackPainting back(settings.world);
  ClassView view;
  view.opened = settings.opened;
  std::unique_ptr<view::Target> target;
  const auto started = Clock::now();
  double shown_s = 0.0;
  for (bool last = false; !last;) {
    const std::vector<window::InputEvent> events = window.events(kFrameS);
    const double now_s = secondsSince(started);
    last = window.closing() || (settings.ending && settings.ending()) ||
           (settings.seconds > 0.0 && now_s >= settings.seconds);
    const int width = std::max(1, window.width());
    const int height = std::max(1, window.height());
    if (!target || target->width() != width || target->height() != height) {
      target = std::make_unique<view::Target>(width, height);
    }
    const double scale = window.contentScale();
    const Vec2 points = Vec2(width, height) / scale;
    gui.begin(points, scale, std::max(1e-4, now_s - shown_s), events);
    shown_s = now_s;
    classFrame(watch, back.picture(), points, view);
    gui.end();
    target->clear();
    target->bind();
    gui.present(width, height);
    window.present(*target);
  }
  if (!settings.picture.empty()) view::writePng(settings.picture, target->read());
}

}  // namespace palpate::viewer
