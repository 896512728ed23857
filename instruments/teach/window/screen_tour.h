// A picture of every screen of the training window, without a window: for the manual, and for review by eye.
//
//   world ─► Viewer, offscreen, with empty records ─ keys, as a person would press them ─► 01-welcome.png ...
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "palpate/scene/world.h"
#include "palpate/training/protocol.h"
#include "view/viewer/state/view_state.h"

namespace palpate::viewer {

struct TourSettings {
  std::filesystem::path folder;
  training::Protocol protocol = training::builtInProtocol();
  int width = 1280;
  int height = 800;
  ViewState state = {};
};

/// The pictures, in their order. Throws Error.
std::vector<std::filesystem::path> tourScreens(const std::shared_ptr<const scene::World>& world,
                                               const TourSettings& settings);

}  // namespace palpate::viewer
