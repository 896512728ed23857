// A training with lumps. A place is named by touching it: Here means the finger's last press, whether a device, the
// mouse or the keyboard moves the finger.
#include <utility>

#include "palpate/scene/lumps_of_body.h"
#include "teach/window/task.h"

namespace palpate::viewer {

namespace {

using lumps::LumpQuestion;
using training::Screen;

/// A touch counts as pointing from this force in the hand on, N: what rests on the skin names nothing.
constexpr double kPointsN = 0.1;
/// A step of the keyboard's finger over the skin, points: about 5 mm where the whole back is seen.
constexpr double kStepPoints = 6.0;

class LumpsTask final : public Task {
 public:
  LumpsTask(const training::SessionPlan& plan, const training::Moment& now) : session_(plan, now) {}

  training::Sitting& session() override { return session_; }
  const training::LumpSession* lumps() const override { return &session_; }

  TrialWorld::Body wanted() const override {
    if (session_.paused() || (session_.screen() != Screen::trial && session_.screen() != Screen::feedback)) return {};
    const int body = session_.bodyNumber();
    return {.hidden = training::HiddenNow{.site = body, .change = 0.0}, .trial = body};
  }
  scene::Scene makeScene(const scene::Scene& base, const TrialWorld::Body& body) const override {
    scene::Scene scene = training::lumpScene(base, session_.plan().bodies->task(), session_.hidden());
    if (!body.hidden) scene.lumps.clear();
    return scene;
  }
  void handleNewWorld(const scene::World& world) override {
    feet_.clear();
    for (const auto& lump : world.lumps) feet_.push_back(lump->lump.foot);
    markPlaces();
  }
  bool padShown() const override { return session_.padShown(); }

  void feel(const trace::Sample& sample, const training::Moment& now) override {
    session_.feel(sample, now);
    const bool touches = sample.contact.touch != contact::Touch::free && sample.device_force.norm() >= kPointsN;
    if (!touches || session_.paused()) return;
    touched_ = sample.contact.proxy;
    markPlaces();
  }

  void describe(TrainingView& view) const override {
    view.lumps = &session_;
    view.touched = touched_.has_value();
    view.named = named_.size();
    view.marks = places_.size();
  }

  /// The keyboard's finger moves over the visible skin, from the middle of the sites.
  std::vector<SeenSite> look(const Sight& sight, KeyboardFinger& finger) override {
    const auto seen_at = [&](const Vec3& point) -> std::optional<Vec2> {
      const Vec2 share = view::seenAt(sight.frustum, point);
      if (!share.allFinite()) return std::nullopt;
      return Vec2(share.cwiseProduct(sight.size_points));
    };
    std::vector<SeenSite> seen;
    for (const Vec3& place : places_) seen.push_back({.at = seen_at(place), .tag_left = place.x() < 0.0});
    finger.moved = finger.moved && !session_.paused();
    if (!finger.moved) return seen;
    const Vec3 from = finger.place ? finger.place->point : roomAround(session_.plan().sites).center();
    const Vec2 step = std::exchange(step_, Vec2::Zero());
    if (const auto at = seen_at(from)) {
      const auto place = sight.pointer.skinAt((*at + Vec2(step.x(), -step.y())) * sight.pixels_per_point);
      if (place) finger.place = place;
    }
    return seen;
  }

  void handle(const TrainingStroke& stroke, KeyboardFinger& finger) override {
    if (stroke.kind == TrainingStroke::Kind::touch) finger.press(!finger.presses);
    if (stroke.kind != TrainingStroke::Kind::walk) return;
    step_ += kStepPoints * stroke.by;
    finger.moved = true;
  }

  std::vector<TrainingClick> button() const override {
    const bool points = session_.question() == LumpQuestion::place && touched_;
    return {{points ? TrainingAct::answer : TrainingAct::next, 0}};
  }

  Acted act(const TrainingClick& click, bool waiting, const training::Moment& now) override {
    if (waiting && click.act != TrainingAct::next) return Acted::nothing;
    const int body = session_.bodyNumber();
    if (click.act == TrainingAct::next) {
      if (session_.screen() == Screen::finished) return Acted::over;
      session_.next(now);
    } else if (click.act == TrainingAct::choose) {
      session_.answer(click.value, now);
    } else if (click.act == TrainingAct::answer) {
      namePlace(now);
    } else if (click.act == TrainingAct::no) {
      session_.noMore(now);
    }
    if (session_.bodyNumber() != body) {
      touched_.reset();
      named_.clear();
      feet_.clear();
    }
    markPlaces();
    return Acted::done;
  }

 private:
  void namePlace(const training::Moment& now) {
    if (!touched_ || !session_.answer(Vec2(touched_->head<2>()), now)) return;
    named_.push_back(*touched_);
    touched_.reset();
  }

  /// The named places, then the touched one or, in feedback, the lumps.
  void markPlaces() {
    places_ = named_;
    if (!session_.shown().empty()) {
      places_.insert(places_.end(), feet_.begin(), feet_.end());
    } else if (touched_ && session_.question() == LumpQuestion::place) {
      places_.push_back(*touched_);
    }
  }

  training::LumpSession session_;
  std::optional<Vec3> touched_;  ///< place on the skin of the newest press of this body
  std::vector<Vec3> named_;      ///< places named in this body
  std::vector<Vec3> feet_;       ///< points on the skin over the body's lumps
  std::vector<Vec3> places_;     ///< of the screen's marks, by their number from 1
  Vec2 step_ = Vec2::Zero();     ///< motion of the keyboard's finger on the screen, points; y up
};

}  // namespace

std::unique_ptr<Task> makeLumpsTask(const training::SessionPlan& plan, const training::Moment& now) {
  return std::make_unique<LumpsTask>(plan, now);
}

}  // namespace palpate::viewer
