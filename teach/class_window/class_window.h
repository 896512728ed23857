// The instructor's window: a tile for each station, who needs help first; one of them opened with its finger on the
// back, its force, its threshold so far; words, pause and the class's learning curve.
//
//   ClassWatch ─ tiles, forces, curve ─► drawing          buttons ─► ClassWatch::ask
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "palpate/classroom/class_watch.h"
#include "palpate/scene/world.h"

namespace palpate::viewer {

struct ClassWindowSettings {
  std::string title = "Palpate";
  std::shared_ptr<const scene::World> world;  ///< whose back is shown; null: none
  int width = 1280;
  int height = 800;
  double seconds = 0.0;          ///< ends by itself; 0: never
  std::string picture;           ///< the last picture goes there (PNG); empty: nowhere
  std::string opened;            ///< a station that is open at first
  std::function<bool()> ending;  ///< somebody outside asks for the end
};

/// Until it is closed. Throws Error without a display.
void runClassWindow(classroom::ClassWatch& watch, const ClassWindowSettings& settings);

}  // namespace palpate::viewer
