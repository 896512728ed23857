// Meanings of keys on a training screen: everything can be done without a mouse.
//
//   InputEvent, TrainingScreen ─ interpretInput ─► what is meant
//
// Pure.
#pragma once

#include <string>

#include "palpate/training/site.h"
#include "palpate/window/input.h"
#include "teach/window/training_painting.h"

namespace palpate::viewer {

struct TrainingStroke {
  enum class Kind : std::uint8_t {
    nothing,       ///< swallowed: a training window has no other keys
    pass,          ///< for the window and the finger: full screen, a picture, deeper, lighter
    press_button,  ///< `click`
    focus,         ///< the button `index`
    letters,       ///< typed `text`
    erase,
    walk,   ///< to the site in the direction `by` of the picked one
    touch,  ///< the keyboard's finger presses or lifts
  };
  Kind kind = Kind::nothing;
  TrainingClick click = {};
  std::size_t index = 0;
  std::string text = {};
  Vec2 by = Vec2::Zero();
};

/// True for every command of mouse and keys that a test does not allow.
bool isForbidden(const window::Command& command);

TrainingStroke interpretInput(const window::InputEvent& event, const TrainingScreen& screen);

/// The nearest site that lies in this direction (x right, y up); the same if none does, the first from none.
int siteTowards(const training::SiteSet& sites, int from, const Vec2& by);

}  // namespace palpate::viewer
