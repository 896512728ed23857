#include "cli/run/opening.h"

#include <optional>
#include <variant>

#include "cli/kit/interruption.h"
#include "palpate/base/error.h"
#include "palpate/base/stopwatch.h"

namespace palpate::app {

Opening showOpening(window::Window& window, engine::WorldBuilder& building, viewer::ViewState& state,
                    const viewer::OpeningView::Offers& offers, const std::function<void()>& shown) {
  constexpr double kFrameS = 0.1;         // unless something happens: the time is the body's
  constexpr double kTimeForMoreS = 0.15;  // a body that is there sooner needs no word
  viewer::OpeningView view(state, offers);
  const auto started = Clock::now();
  for (;;) {
    if (std::optional<engine::BuildResult> result = building.take()) {
      if (!result->world) throw Error(result->error);
      return {result->world, view.page(), view.asks().requests, view.asks().actions};
    }
    const std::vector<window::InputEvent> events = window.events(kFrameS);
    const auto& requests = view.asks().requests;
    const bool leaves = !requests.empty() && std::holds_alternative<viewer::StartTraining>(requests.back());
    if (window.closing() || endAskedBy() != 0 || leaves) return {nullptr, false, requests};
    if (!offers.page && secondsSince(started) < kTimeForMoreS) continue;
    view.frame({window.width(), window.height(), window.contentScale(), kFrameS}, events, building.progress());
    window.present(view.target());
    shown();
  }
}

}  // namespace palpate::app
