// A training of places: one of the body's sites is stiffer, and is named by its number.
#include <algorithm>
#include <charconv>
#include <utility>

#include "palpate/training/records/trainee_code.h"
#include "palpate/training/session/trial_scene.h"
#include "teach/window/task.h"

namespace palpate::viewer {

namespace {

using training::Screen;

/// Digits that follow each other faster belong to one number, ms.
constexpr std::int64_t kSameNumberMs = 1500;
/// Margin of the body around the sites that shows where on it they are, mm.
constexpr double kRoomAsideMm = 110.0;
/// Bodies of familiarisation have numbers below those of trials and below TrialWorld's "none".
constexpr int kFamiliarBodies = -2;
/// Farther from its site than this, the visible skin is another side of the body, mm.
constexpr double kSameSideMm = 25.0;

class PlacesTask final : public Task {
 public:
  PlacesTask(const training::SessionPlan& plan, const training::Moment& now) : session_(plan, now) {}

  training::Sitting& session() override { return session_; }
  training::Session* places() override { return &session_; }

  TrialWorld::Body wanted() const override {
    if (session_.paused()) return {};
    // Each request of familiarisation is another body too; trials count from 1.
    if (const auto pair = session_.familiarPlaces()) return {session_.hidden(), kFamiliarBodies - pair->round};
    if (session_.screen() == Screen::feedback) return {session_.hidden(), session_.trials().back().number};
    return {session_.hidden(), session_.screen() == Screen::trial ? session_.trialNumber() : 0};
  }
  scene::Scene makeScene(const scene::Scene& base, const TrialWorld::Body& body) const override {
    const training::SessionPlan& plan = session_.plan();
    return training::trialScene(base, plan.protocol, plan.kind, plan.sites, body.hidden);
  }

  void describe(TrainingView& view) const override {
    view.session = &session_;
    view.picked = picked_;
  }

  std::vector<SeenSite> look(const Sight& sight, KeyboardFinger& finger) override {
    std::vector<SeenSite> all;
    for (const training::Site& site : sites().sites) {
      SeenSite seen;
      const Vec2 share = view::seenAt(sight.frustum, site.point_mm);
      if (share.allFinite()) {
        const Vec2 at = share.cwiseProduct(sight.size_points);
        const auto place = sight.pointer.skinAt(at * sight.pixels_per_point);
        if (place && (place->point - site.point_mm).norm() < kSameSideMm) seen.at = at;
        if (place && site.number == picked_ && finger.moved) finger.place = place;
      }
      const double middle = view::seenAt(sight.frustum, Vec3(0.0, site.point_mm.y(), site.point_mm.z())).x();
      seen.tag_left = site.side == training::Side::left ? share.x() <= middle : share.x() < middle;
      all.push_back(seen);
    }
    return all;
  }

  void handle(const TrainingStroke& stroke, KeyboardFinger& finger) override {
    using Kind = TrainingStroke::Kind;
    if (stroke.kind == Kind::letters) return type(stroke.text);
    if (stroke.kind == Kind::erase) {
      picked_ = 0;
    } else if (stroke.kind == Kind::walk) {
      walk(stroke.by);
      finger.press(false);
    } else if (stroke.kind == Kind::touch) {
      finger.press(!finger.presses && picked_ != 0);
    } else {
      return;
    }
    digits_.clear();
  }

  std::vector<TrainingClick> button() const override {
    if (!session_.asks()) return {{TrainingAct::next, 0}};
    const int site = session_.touchedSite();
    if (site == 0) return {};
    return {{TrainingAct::pick_site, site}, {TrainingAct::answer, 0}};
  }

  Acted act(const TrainingClick& click, bool waiting, const training::Moment& now) override {
    switch (click.act) {
      case TrainingAct::next:
        if (session_.screen() == Screen::finished) return Acted::over;
        if (waiting && session_.screen() == Screen::feedback) return Acted::nothing;
        session_.next(now);
        if (session_.screen() != Screen::feedback) picked_ = 0;
        return Acted::done;
      case TrainingAct::pick_site:
        if (canPick(click.value)) picked_ = click.value;
        digits_.clear();
        return Acted::nothing;
      case TrainingAct::answer:
        if (picked_ == 0 || waiting) return Acted::nothing;
        if (session_.answer(picked_, now)) {
          picked_ = session_.screen() == Screen::feedback && session_.hidden() ? session_.hidden()->site : 0;
          digits_.clear();
        }
        return Acted::done;
      default:
        return Acted::nothing;
    }
  }

 private:
  const training::SiteSet& sites() const { return session_.plan().sites; }

  /// Familiarisation knows two places alone.
  bool canPick(int site) const {
    const auto pair = session_.familiarPlaces();
    return pair ? site == pair->first || site == pair->second : sites().numbered(site) != nullptr;
  }

  void walk(const Vec2& by) {
    const auto pair = session_.familiarPlaces();
    picked_ = !pair ? siteTowards(sites(), picked_, by) : picked_ == pair->first ? pair->second : pair->first;
  }

  /// A number that is typed picks its site: the digits together where there is such a site, else the last one alone.
  void type(const std::string& letters) {
    const std::int64_t now_ms = training::utcMs();
    if (now_ms - std::exchange(digits_ms_, now_ms) > kSameNumberMs) digits_.clear();
    for (const char letter : letters) {
      if (letter < '0' || letter > '9') continue;
      for (const std::string& candidate : {digits_ + letter, std::string(1, letter)}) {
        int number = 0;
        std::from_chars(candidate.data(), candidate.data() + candidate.size(), number);
        if (sites().numbered(number) == nullptr) continue;
        digits_ = candidate;
        if (canPick(number)) picked_ = number;
        break;
      }
    }
  }

  training::Session session_;
  int picked_ = 0;
  std::string digits_;
  std::int64_t digits_ms_ = 0;  ///< when the last of them came
};

}  // namespace

std::unique_ptr<Task> makeTask(const training::SessionPlan& plan) {
  const training::Moment now{.utc_ms = training::utcMs()};
  if (training::hidesLumps(plan.kind)) return makeLumpsTask(plan, now);
  return std::make_unique<PlacesTask>(plan, now);
}

Eigen::AlignedBox3d roomAround(const training::SiteSet& sites) {
  Eigen::AlignedBox3d box;
  for (const training::Site& site : sites.sites) box.extend(site.point_mm);
  const Vec3 room(kRoomAsideMm, kRoomAsideMm, 0.0);
  return Eigen::AlignedBox3d(box.min() - room, box.max() + room);
}

}  // namespace palpate::viewer
