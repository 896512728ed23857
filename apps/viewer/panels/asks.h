// How a panel asks for what it cannot do itself: wishes, actions as of a key, words for the user, and notes of what it
// changed in the scene. Plain data; whoever draws the panels looks at it afterwards.
//
//   panel ─► Asks ─► drawGui: actions, words ─► Viewer: wishes, consequences of changes, once a frame
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "apps/viewer/panels/messages.h"
#include "palpate/window/keys.h"

namespace palpate::viewer {

/// What a change of the scene has consequences for; bits.
enum Consequence : std::uint32_t {
  kNothing = 0,
  kFingerChange = 1,  ///< the servo's settings
  kMapChange = 2,     ///< what lies on the body: maps, laws, forms of the deformation
  kBodyChange = 4,    ///< the body itself
};

/// What only the viewer can do.
struct Wish {
  enum class Kind : std::uint8_t {
    open,        ///< `file`
    save,        ///< the scene, to `file` or where it came from
    screenshot,  ///< without what lies over the picture for a moment
    screenshot_with_pop_ups,
    plots_csv,
    record,    ///< start or stop
    sequence,  ///< PNG files: start or stop
    home,
    full_screen,
    cancel_build,
    copy_view,
    paste_view,
    default_scene,
    use_profile,  ///< the drawn curve: written to a file that the scene names
    quit,
  };
  Kind kind = Kind::open;
  std::string file = {};
};

struct Asks {
  std::uint32_t changed = kNothing;  ///< Consequence bits of this frame
  std::vector<Wish> wishes;
  std::vector<window::Action> actions;  ///< done as if their keys had been pressed
  struct Words {
    Severity severity;
    std::string text;
  };
  std::vector<Words> words;

  void wish(Wish::Kind kind, std::string file = {}) { wishes.push_back({kind, std::move(file)}); }
  void act(window::Action action) { actions.push_back(action); }
  void tell(Severity severity, std::string text) { words.push_back({severity, std::move(text)}); }
};

}  // namespace palpate::viewer
