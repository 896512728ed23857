#include "cli/run/opening.h"

#include <optional>
#include <variant>

#include "cli/kit/interruption.h"
#include "palpate/base/error.h"
#include "palpate/base/stopwatch.h"

namespace palpate::app {

namespace {

/// Only the last of successive moves counts: however long a body takes, only clicks and keys become many.
void appendEvents(std::span<const window::InputEvent> events, std::vector<window::InputEvent>& kept) {
  for (const window::InputEvent& event : events) {
    const auto is_move = [](const window::InputEvent& e) { return e.kind == window::InputEvent::Kind::move; };
    if (is_move(event) && !kept.empty() && is_move(kept.back())) kept.pop_back();
    kept.push_back(event);
  }
}

}  // namespace

Opening showOpening(window::Window& window, engine::WorldBuilder& building, viewer::ViewState& state,
                    const viewer::OpeningView::Offers& offers, const std::function<void()>& shown) {
  constexpr double kFrameS = 0.1;         // unless something happens: the body needs the time
  constexpr double kTimeForMoreS = 0.15;  // a body that is ready sooner needs no message
  viewer::OpeningView view(state, offers);
  std::vector<window::InputEvent> for_the_body;
  const auto started = Clock::now();
  for (;;) {
    std::optional<engine::BuildResult> result;
    if (!view.isBeingClicked()) result = building.collectResult();
    if (result) {
      if (!result->world) throw Error(result->error);
      window.handBack(for_the_body);
      return {result->world, view.page(), view.awaited(), view.output().requests, view.output().actions};
    }
    const std::vector<window::InputEvent> events = window.events(kFrameS);
    const auto& requests = view.output().requests;
    const bool leaves = !requests.empty() && std::holds_alternative<viewer::GiveWay>(requests.back());
    if (window.closing() || endingSignal() != 0 || leaves) return {.world = nullptr, .requests = requests};
    if (!offers.page && secondsSince(started) < kTimeForMoreS) {
      appendEvents(events, for_the_body);
      continue;
    }
    const viewer::OpeningView::Frame frame{window.width(), window.height(), window.contentScale(), kFrameS};
    appendEvents(view.frame(frame, events, building.progress()), for_the_body);
    window.present(view.target());
    shown();
  }
}

}  // namespace palpate::app
