#include "apps/viewer/turnover.h"

#include <utility>

#include "apps/viewer/files/state_file.h"
#include "palpate/base/error.h"

namespace palpate::viewer {

namespace {

constexpr const char* kCannotOpen = "cannot open ";

}  // namespace

void Turnover::open(const std::string& file, const Session& session) {
  opening_ = true;
  wanted_ = 0;
  builder_.wish({session.scene, nullptr, file});
}

void Turnover::open(const scene::Scene& scene, Session& session) {
  session.scene = scene;
  session.scene_file.clear();
  session.editor = {};
  opening_ = false;
  wanted_ = 0;
  builder_.wish({scene, nullptr, {}});
}

void Turnover::cancel(Session& session) {
  builder_.cancel();
  wanted_ = 0;
  opening_ = false;
  // What is at work is what is wished again.
  session.scene.body = shown_->scene.body;
  session.report(Severity::info, "Cancelled: the body stays as it was");
}

void Turnover::advance(Session& session, LiveServo& servo) {
  if (session.changed & kFingerChange) changeFingers(session, servo);
  if (const std::uint32_t world = session.changed & (kMapChange | kBodyChange)) {
    wanted_ |= world;
    wanted_since_s_ = session.now_s;
  }
  wishWhenQuiet(session);
  takeResult(session, servo);
  session.building = builder_.progress();
}

void Turnover::wishWhenQuiet(Session& session) {
  if (wanted_ == 0 || opening_ || session.now_s - wanted_since_s_ < kQuietS) return;
  BuildWish wish{session.scene, nullptr, {}};
  if (!(wanted_ & kBodyChange)) wish.body = coming_ ? coming_ : shown_;
  wanted_ = 0;
  builder_.wish(std::move(wish));
}

void Turnover::takeResult(Session& session, LiveServo& servo) {
  const auto result = builder_.take();
  if (!result) return;
  const bool opened = std::exchange(opening_, false) && !result->wish.open.empty();
  if (!result->world) {
    session.report(Severity::error, (opened ? kCannotOpen : "") + result->error);
    return;
  }
  if (opened) {
    session.messages.clearErrors(kCannotOpen);
    remember(session.state.recent, result->wish.open);
    session.scene = result->world->scene;
    session.scene_file = session.scene.body.kind == scene::BodyKind::mesh && session.scene.file.empty()
                             ? std::string()
                             : session.scene.file.string();
    session.editor = {};
  }
  adopt(session, *result, servo);
}

void Turnover::adopt(Session& session, const BuildResult& result, LiveServo& servo) {
  try {
    servo.change(planFor(result.world, session.scene, result.wish.body == nullptr));
  } catch (const Error& error) {
    session.report(Severity::error, error.what());
    return;
  }
  coming_ = result.world;
  other_body_ = other_body_ || result.wish.body == nullptr;
}

void Turnover::changeFingers(Session& session, LiveServo& servo) const {
  try {
    servo.change(planFor(coming_ ? coming_ : shown_, session.scene, coming_ && other_body_));
  } catch (const Error& error) {
    session.report(Severity::warning, error.what());
  }
}

Turnover::Shown Turnover::takeShown(LiveServo& servo) {
  servo.exchange();
  if (!coming_ || servo.plan().world != coming_) return {};
  shown_ = std::exchange(coming_, nullptr);
  return {shown_, std::exchange(other_body_, false)};
}

}  // namespace palpate::viewer
