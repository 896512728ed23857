#include "teach/study/eye_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "palpate/base/error.h"
#include "palpate/device/mouse_finger.h"
#include "palpate/engine/fingers.h"
#include "palpate/engine/living_skin.h"
#include "palpate/scene/presets.h"
#include "palpate/training/trainee/trainee_course.h"
#include "palpate/view/orbit.h"
#include "palpate/view/overlays/lens.h"
#include "palpate/view/overlays/sink_rings.h"

namespace palpate::study {

namespace {

/// The body's share of a training window of 1280 x 800, and how much of the body it shows round the sites.
constexpr int kPictureWidth = 980;
constexpr int kPictureHeight = 776;
constexpr double kRoomRoundSitesMm = 110.0;
/// The finger touches and has not sunk in, N.
constexpr double kBareTouchN = 0.05;
/// A press has come to rest after this, s.
constexpr double kPressSettledS = 1.5;
/// The drawn finger's cuff is the only thing this much bluer than red; the rings are the only thing so white.
constexpr int kCuffBlueOverRed = 40;
constexpr int kRingWhite = 225;

view::PictureSettings windowSettings(const training::SiteSet& sites) {
  Eigen::AlignedBox3d box;
  for (const training::Site& site : sites.sites) box.extend(site.point_mm);
  const Vec3 room(kRoomRoundSitesMm, kRoomRoundSitesMm, 0.0);
  view::PictureSettings settings;
  settings.camera = view::fitted(Eigen::AlignedBox3d(box.min() - room, box.max() + room),
                                 static_cast<double>(kPictureWidth) / kPictureHeight);
  settings.look.finger = view::FingerShape::finger;
  settings.look.lens = true;
  settings.labels = view::LabelSettings::none();
  return settings;
}

/// The window's finger: a fingertip where the scene gives none.
contact::FingerSettings windowFinger(const scene::World& world) {
  constexpr double kFingertipRadiusMm = 8.0;
  contact::FingerSettings settings = engine::fingerSettings(world.scene, 1).front();
  if (settings.radius_mm <= 0.0) settings.radius_mm = kFingertipRadiusMm;
  return settings;
}

/// Presses as the servo does, until the press has settled.
contact::FingerOutput pressed(const scene::World& world, const SkinPlace& place, double force_n) {
  const contact::FingerSettings settings = windowFinger(world);
  device::MouseFinger mouse({.tick_s = settings.tick_s});
  device::FingerTarget target{.present = true,
                              .pressed = true,
                              .by = device::PressBy::force,
                              .force_n = force_n,
                              .radius_mm = settings.radius_mm,
                              .place = place.point,
                              .normal = place.normal};
  contact::FingerState state;
  contact::FingerOutput felt;
  const int ticks = static_cast<int>(std::lround(kPressSettledS / settings.tick_s));
  for (int i = 0; i < ticks; ++i) {
    const device::FingerStep step = mouse.step(target, felt.force);
    if (step.jumped) state = {};
    felt = contact::step(world.surface, settings, state, step.tip);
  }
  return felt;
}

struct PixelBox {
  int left, top, right, below;
  bool holds(int x, int y) const { return x >= left && x < right && y >= top && y < below; }
};

/// Mean row of the cuff's lower edge, at the side of the close view where the finger comes in and nothing hides it;
/// nothing where it is not seen. Its upper edge may lie outside.
std::optional<double> cuffRow(const view::Image& image, const PixelBox& lens) {
  constexpr int kShareOfLens = 6;
  double rows = 0.0;
  int columns = 0;
  for (int x = lens.left + 1; x < lens.left + (lens.right - lens.left) / kShareOfLens; ++x) {
    for (int y = lens.below - 1; y >= lens.top; --y) {
      const view::Pixel& pixel = image.at(x, y);
      if (int{pixel[2]} - int{pixel[0]} < kCuffBlueOverRed) continue;
      rows += y;
      ++columns;
      break;
    }
  }
  if (columns == 0) return std::nullopt;
  return rows / columns;
}

bool isWhite(const view::Pixel& pixel) {
  return std::ranges::all_of(pixel, [](int c) { return c >= kRingWhite; });
}

/// Half the width of new white pixels outside the close view.
double ringsHalfWidth(const view::Image& before, const view::Image& image, const PixelBox& lens) {
  int left = image.width;
  int right = -1;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (lens.holds(x, y) || !isWhite(image.at(x, y)) || isWhite(before.at(x, y))) continue;
      left = std::min(left, x);
      right = std::max(right, x);
    }
  }
  return right < left ? 0.0 : 0.5 * (right - left + 1);
}

}  // namespace

struct EyePictures::Impl {
  training::SiteSet sites;
  training::TrialWorlds worlds;
  view::PictureSettings settings;
  view::Studio studio;

  Impl(const scene::World& body, const training::Protocol& protocol)
      : sites(training::sitesOn(body, protocol)),
        worlds(body, protocol, training::SessionKind::pre_test, sites),
        settings(windowSettings(sites)),
        studio(worlds.even()) {}

  view::FingerMark press(int site, double change, double force_n) const {
    const training::Site& at = *sites.numbered(site);
    std::optional<training::HiddenNow> hidden;
    if (change > 0.0) hidden = training::HiddenNow{.site = site, .change = change};
    const auto world = worlds.with(hidden);
    const auto place = view::skinAlong(world->surface, {at.point_mm + Vec3(0, 0, 50.0), -Vec3::UnitZ()});
    if (!place) throw Error(fmt::format("eye: no skin under site {}", site));
    view::FingerMark mark;
    mark.contact = pressed(*world, *place, force_n);
    mark.haptic_radius_mm = windowFinger(*world).radius_mm;
    mark.radius_mm = mark.haptic_radius_mm;
    return mark;
  }

  view::Image draw(const view::FingerMark& mark) {
    // A hidden place changes the feel, not the body: the even world draws them all.
    const scene::World& world = *worlds.even();
    engine::LivingSkin skin(world, {.strain = false, .fingers = 1});
    skin.follow(std::span<const contact::FingerOutput>(&mark.contact, 1));
    const std::vector<view::Lines> rings = view::sinkRings(world, mark.contact);
    return studio
        .capture(skin.surface(), {.fingers = {&mark, 1}, .marks = rings}, settings, {kPictureWidth, kPictureHeight, 1})
        .image;
  }

  PixelBox lens(const view::FingerMark& mark) const {
    const auto place = view::lensPlace(settings.look, {&mark, 1}, Vec2f(kPictureWidth, kPictureHeight));
    if (!place) throw Error("eye: the picture has no room for the close view");
    const Eigen::Vector2i corner = place->corner.cast<int>();
    const Eigen::Vector2i size = place->size.cast<int>();
    return {corner.x(), corner.y(), corner.x() + size.x(), corner.y() + size.y()};
  }
};

EyePictures::EyePictures(const training::Protocol& protocol)
    : impl_(std::make_unique<Impl>(*scene::build(scene::standardScene()), protocol)) {}
EyePictures::~EyePictures() = default;

int EyePictures::sites() const { return impl_->sites.choices(); }

view::Image EyePictures::picture(int site, double change, double force_n) {
  return impl_->draw(impl_->press(site, change, force_n));
}

EyeReading EyePictures::read(int site, double change) {
  const view::FingerMark touching = impl_->press(site, change, kBareTouchN);
  const view::FingerMark pressing = impl_->press(site, change, kEyePressN);
  const view::Image before = impl_->draw(touching);
  const view::Image image = impl_->draw(pressing);
  const PixelBox lens = impl_->lens(pressing);
  const auto from = cuffRow(before, lens);
  const auto to = cuffRow(image, lens);
  if (!from || !to) throw Error(fmt::format("eye: the finger is not seen in the close view of site {}", site));
  return {.sink = *to - *from, .rings = ringsHalfWidth(before, image, lens)};
}

EyeSites readSites(EyePictures& pictures, double change, int sites, const Progress& progress) {
  EyeSites found{.change = change, .normal = {}, .stiffer = {}};
  const int all = pictures.sites();
  const int some = std::clamp(sites, 2, all);
  for (int i = 0; i < some; ++i) {
    const int site = 1 + i * all / some;
    report(progress, "drawing presses", static_cast<double>(i) / some);
    found.normal.push_back(pictures.read(site, 0.0));
    found.stiffer.push_back(pictures.read(site, change));
  }
  return found;
}

}  // namespace palpate::study
