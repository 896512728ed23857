#include "cli/run/control_lines.h"

#include <fmt/format.h>

#include <cstdio>
#include <string>

namespace palpate::app {

void ControlLines::print(double scale) {
  const viewer::WidgetPlaces& now = viewer::widgetPlaces();
  if (now == before_) return;
  std::string lines;
  for (const auto& [path, place] : now) {
    const auto known = before_.find(path);
    if (known != before_.end() && known->second == place) continue;
    lines += fmt::format("control {}", path);
    for (const float edge : place) lines += fmt::format(" {:.0f}", scale * static_cast<double>(edge));
    lines += '\n';
  }
  for (const auto& [path, place] : before_) {
    if (!now.contains(path)) lines += fmt::format("control {} gone\n", path);
  }
  before_ = now;
  std::fwrite(lines.data(), 1, lines.size(), stdout);
  std::fflush(stdout);
}

}  // namespace palpate::app
