// The window's first second: the start page, or the progress, before there is a body that the viewer can show.
//
//   run ─► OpeningView::frame, until the body is built ─► its requests, `page` ─► Viewer
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>

#include "palpate/view/offscreen.h"
#include "palpate/window/gui.h"
#include "view/viewer/panels/start_page.h"
#include "view/viewer/state/view_state.h"

namespace palpate::viewer {

/// Needs a current GL context; belongs to its thread.
class OpeningView {
 public:
  struct Offers {
    bool page = true;                             ///< the start page; else only the progress
    std::function<Activities()> activities = {};  ///< called while the page is shown
  };
  /// `state` must outlive it.
  OpeningView(ViewState& state, const Offers& offers) : state_(state), offers_(offers), page_(offers.page) {}

  struct Frame {
    int width;
    int height;
    double scale;      ///< pixels per point of the screen
    double elapsed_s;  ///< since the frame before
  };
  /// Returns the last events, after the page was closed: they are for the body, which is still being built.
  std::span<const window::InputEvent> frame(const Frame& frame, std::span<const window::InputEvent> events,
                                            const std::optional<engine::BuildProgress>& building);
  /// Whether a button is down on the page: its effect is known when it goes up.
  bool isBeingClicked() const;
  const view::Target& target() const { return *target_; }
  /// Whether the page is still open.
  bool page() const { return page_; }
  UiOutput& output() { return output_; }
  /// The activity that the page waits for, to open it.
  std::optional<Activity> awaited() const { return awaited_; }

 private:
  ViewState& state_;
  Offers offers_;
  bool page_;
  Activities activities_ = {};
  std::optional<Activity> awaited_;
  UiOutput output_;
  window::Gui gui_;
  ExamplePictures pictures_;
  std::unique_ptr<view::Target> target_;
};

}  // namespace palpate::viewer
