// `palpate run` before its body is built: the start page, or the progress of the body.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "palpate/engine/world_builder.h"
#include "palpate/window/window.h"
#include "view/viewer/opening_view.h"

namespace palpate::app {

/// Requests to the window while its body was being built.
struct Opening {
  std::shared_ptr<const scene::World> world;     ///< null: the window was closed
  bool page = false;                             ///< the start page is still open
  std::optional<viewer::Activity> awaited = {};  ///< the page opens it when it is built
  std::vector<viewer::Request> requests = {};
  std::vector<window::Action> actions = {};
};

/// Runs until the body is built or the window is closed; `shown` is called after each picture. Throws Error if it
/// cannot be built.
Opening showOpening(window::Window& window, engine::WorldBuilder& building, viewer::ViewState& state,
                    const viewer::OpeningView::Offers& offers, const std::function<void()>& shown);

}  // namespace palpate::app
