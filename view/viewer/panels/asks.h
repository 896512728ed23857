// How a panel asks for what it cannot do itself: wishes, actions as of a key, words for the user, and notes of what it
// changed in the scene. Plain data; whoever draws the panels looks at it afterwards.
//
//   panel ─► Asks ─► drawGui: actions, words ─► Viewer: wishes, consequences of changes, once a frame
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "view/viewer/panels/messages.h"
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
    open,         ///< `file`
    open_beside,  ///< a session, beside the one that is shown
    save,         ///< the scene, to `file` or where it came from
    reload,       ///< what was opened, once more
    reset,        ///< everything as it was opened or saved
    undo,
    redo,
    answer,      ///< `file`: what was chosen of the question's answers
    screenshot,  ///< without what lies over the picture for a moment
    screenshot_with_pop_ups,
    clear_screenshot,  ///< the body alone, the rest transparent
    play_script,       ///< the scene's own fingers, or an end of it
    copy_scene,        ///< what is seen and felt now, as the text of a scene
    plots_csv,
    record,  ///< start or stop
    keep_session,
    mark,      ///< in the session; `file`: what it says
    sequence,  ///< PNG files: start or stop
    home,
    full_screen,
    cancel_build,
    copy_view,
    paste_view,
    default_scene,
    open_device,   ///< `file`, as for --device, takes `finger`
    close_device,  ///< of `finger`
    find_devices,  ///< which back ends are here, and why not
    stop,          ///< the emergency stop
    release_stop,
    use_profile,     ///< the drawn curve: written to a file that the scene names
    measure_before,  ///< `file`: a photograph of dots, before the skin is dragged
    measure_after,   ///< `file`: and after
    swap_photos,
    accept_measurement,
    cancel_measuring,  ///< the work under way
    quit,
  };
  Kind kind = Kind::open;
  std::string file = {};
  bool sure = false;  ///< whatever it may overwrite or throw away
  std::size_t finger = 0;
};

/// What is asked before something would be lost; what was wished waits in it.
struct Question {
  enum class Kind : std::uint8_t {
    leave,      ///< changes would be thrown away
    overwrite,  ///< a file would be that is not known here
    accept,     ///< a measurement that something speaks against
    unmeasure,  ///< what was corrected by hand in photographs would be thrown away
  };
  Kind kind = Kind::leave;
  std::string words = {};
  std::string file = {};          ///< overwrite: which
  std::optional<Wish> then = {};  ///< what is done after the answer
};
/// Answers, as the buttons say them; the first is what Enter means, the last what Esc means.
inline constexpr std::array<std::string_view, 3> kLeaveAnswers = {"Save", "Discard", "Stay"};
inline constexpr std::array<std::string_view, 2> kOverwriteAnswers = {"Overwrite", "Cancel"};
inline constexpr std::array<std::string_view, 2> kAcceptAnswers = {"Accept", "Cancel"};
inline constexpr std::array<std::string_view, 3> kUnmeasureAnswers = {"Accept", "Discard", "Stay"};
inline std::span<const std::string_view> answersTo(const Question& question) {
  if (question.kind == Question::Kind::leave) return kLeaveAnswers;
  if (question.kind == Question::Kind::accept) return kAcceptAnswers;
  if (question.kind == Question::Kind::unmeasure) return kUnmeasureAnswers;
  return kOverwriteAnswers;
}

struct Asks {
  std::uint32_t changed = kNothing;  ///< Consequence bits of this frame
  std::vector<Wish> wishes;
  std::vector<window::Action> actions;  ///< done as if their keys had been pressed
  struct Words {
    Severity severity;
    std::string text;
  };
  std::vector<Words> words;
  std::string step;  ///< what the change of this frame is called when it is taken back; empty: by what it changed

  void wish(Wish::Kind kind, std::string file = {}) { wishes.push_back({kind, std::move(file)}); }
  void wishForFinger(Wish::Kind kind, std::size_t finger, std::string words = {}) {
    wishes.push_back({.kind = kind, .file = std::move(words), .finger = finger});
  }
  void act(window::Action action) { actions.push_back(action); }
  void tell(Severity severity, std::string text) { words.push_back({severity, std::move(text)}); }
};

}  // namespace palpate::viewer
