#include "view/viewer/modes/mode.h"

#include <algorithm>

namespace palpate::viewer {

Claims Modes::claims() const {
  Claims all;
  for (const auto& mode : modes_) {
    const Claims claims = mode->claims();
    all.window = all.window || claims.window;
    all.body = all.body || claims.body;
    all.touch = all.touch || claims.touch;
  }
  return all;
}

Mode* Modes::claimant(bool Claims::*part) const {
  const auto found = std::ranges::find_if(modes_, [part](const auto& mode) { return mode->claims().*part; });
  return found == modes_.end() ? nullptr : found->get();
}

std::optional<Eigen::AlignedBox3d> Modes::homeBox() const {
  for (const auto& mode : modes_) {
    if (const auto box = mode->homeBox()) return box;
  }
  return std::nullopt;
}

bool Modes::handle(const window::InputEvent& event, ViewerState& viewer, bool typing) const {
  return std::ranges::any_of(modes_, [&](const auto& mode) { return mode->handle(event, viewer, typing); });
}

bool Modes::handle(const window::Command& command, ViewerState& viewer) const {
  return std::ranges::any_of(modes_, [&](const auto& mode) { return mode->handle(command, viewer); });
}

bool Modes::handle(const Request& request, ViewerState& viewer) const {
  return std::ranges::any_of(modes_, [&](const auto& mode) { return mode->handle(request, viewer); });
}

void Modes::answer(const Question& question, std::string_view chosen, ViewerState& viewer) const {
  for (const auto& mode : modes_) {
    if (mode->answer(question, chosen, viewer)) return;
  }
}

}  // namespace palpate::viewer
