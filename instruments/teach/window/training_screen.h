// A training screen as plain data: every word, button and mark. The painting (training_painting.h) only places them, so
// a test that reads this has read all that is on the screen.
//
//   front desk, session ─ makeTrainingScreen (training_words.h) ─► TrainingScreen ─► painting, speech
//                                                              a key, a click ─► TrainingAct ─► desk
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace palpate::viewer {

/// Action of a button or a key.
enum class TrainingAct : std::uint8_t {
  none,
  sign_in,    ///< with the typed code
  make_code,  ///< for a trainee without one
  yes,        ///< to the question of the screen
  no,         ///< back
  choose,     ///< the offer, hand or thimble `value`
  next,       ///< "Next", "Start", "Continue"
  pick_site,  ///< the site `value` is the one that would be answered
  answer,     ///< the site that was picked
  pause,
  go_on,
  leave,     ///< asks first
  sign_out,  ///< another trainee
  quit,      ///< the window
  retry,     ///< writes again what could not be written
};

struct TrainingButton {
  TrainingAct act = TrainingAct::none;
  int value = 0;
  std::string label = {};
  std::string line = {};   ///< one line under it
  std::string badge = {};  ///< next to the label: "suggested"
  bool enabled = true;
};

inline TrainingButton button(TrainingAct act, std::string label, std::string line = {}) {
  return {.act = act, .label = std::move(label), .line = std::move(line)};
}

/// Look of a site. Never distinguished by colour alone: each has a shape of its own.
struct SiteMark {
  int number = 0;
  bool pressed = false;  ///< enough: its dot is filled
  bool picked = false;   ///< would be answered: in brackets
  bool touched = false;  ///< a finger is on it: a second ring
  bool is_true = false;  ///< when it is shown: an arrow to it
  bool is_own = false;   ///< feedback alone: the answered site
  /// At the arrow's far end: "feel it here", "your answer"; empty: nothing.
  std::string word = {};
};

enum class TrainingPlace : std::uint8_t {
  card,  ///< a sheet in the middle
  body,  ///< the body is there to be felt, text above it, buttons next to it
};

struct TrainingScreen {
  TrainingPlace place = TrainingPlace::card;
  std::string title = {};
  std::vector<std::string> lines = {};
  struct Entry {
    std::string label;
    std::string text;
    friend bool operator==(const Entry&, const Entry&) = default;
  };
  std::optional<Entry> entry = {};
  std::vector<TrainingButton> buttons = {};
  std::size_t focus = 0;  ///< index of the button that Enter presses
  std::vector<SiteMark> sites = {};
  bool picks_sites = false;              ///< sites can be picked: their list is next to the body
  bool shows_sink = false;               ///< visual substitute for the hand: rings and a close view from the side
  std::optional<double> time_left = {};  ///< share of the trial's time; nothing: no ring
  std::optional<double> done = {};       ///< share of the block, as a bar without a number
  std::string progress = {};             ///< practice alone: "Trial 3 of 20, two right"
  std::string notice = {};               ///< news or a request, e.g. "Answer saved."
  bool trouble = false;                  ///< the notice is about something that must be mended
  enum class Outcome : std::uint8_t { none, right, wrong } outcome = Outcome::none;  ///< feedback: a tick or a cross
  std::string keys = {};    ///< help on the keys of this screen
  std::string corner = {};  ///< the signed-in trainee
};

}  // namespace palpate::viewer
