#include "apps/viewer/hints.h"

#include <array>

namespace palpate::viewer {

void countHint(const view::Command& command, Session& session) {
  using Kind = view::Command::Kind;
  // In the order of hintText.
  static constexpr std::array<Kind, 5> kActs = {Kind::press, Kind::deepen, Kind::slide, Kind::orbit, Kind::act};
  const auto hint = static_cast<std::size_t>(session.hint);
  if (hint >= kActs.size() || command.kind != kActs[hint]) return;
  if (command.kind == Kind::act && command.action != view::Action::help) return;
  if (++session.hint == static_cast<int>(kActs.size())) session.state.hints = false;
}

}  // namespace palpate::viewer
