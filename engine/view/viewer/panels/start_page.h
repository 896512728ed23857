// The window's first offer: touch, train, open, measure, and examples with pictures. A dialog over the body, or alone
// while the body is still being built.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "palpate/engine/world_builder.h"
#include "palpate/view/layers/embedded_file.h"
#include "palpate/view/offscreen.h"
#include "view/viewer/state/activities.h"
#include "view/viewer/state/requests.h"

namespace palpate::viewer {

/// Small pictures of presets, as JPEG files that are part of the program: "back.jpg".
std::span<const view::EmbeddedFile> startPictures();
/// The picture of one preset; empty if there is none.
std::string_view pictureBytes(std::string_view preset);

/// Uploaded to the graphics card on first use. Belongs to the thread of its context.
class ExamplePictures {
 public:
  /// 0: none.
  view::GlId of(std::string_view preset);

 private:
  std::map<std::string_view, view::FlatPicture> shown_;
};

struct StartPage {
  std::span<const std::string> recent;  ///< files, newest first
  bool& shown_at_start;
  ExamplePictures& pictures;
  const Activities& activities;
  std::optional<Activity>& awaited;                    ///< opens when it is built
  std::optional<engine::BuildProgress> building = {};  ///< for the body behind it
};

/// `open` becomes false when something was chosen.
void startPage(const StartPage& page, bool& open, UiOutput& output);

}  // namespace palpate::viewer
