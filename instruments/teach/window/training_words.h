// From a trainee's stage to the screen's text: words, buttons and marks of every screen of the training window.
//
//   TrainingView (front desk or session, and what was typed and picked) ─ makeTrainingScreen ─► TrainingScreen
//
// Pure. The hidden place of a test never gets this far: only feedback's site is read.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/language.h"
#include "palpate/training/session/session.h"
#include "teach/window/offers.h"
#include "teach/window/training_screen.h"

namespace palpate::training {
class LumpSession;
}  // namespace palpate::training

namespace palpate::viewer {

enum class TrainingStage : std::uint8_t {
  sign_in,
  new_code,  ///< first sign-in with this code here
  own_code,  ///< one was made up, to be written down
  consent,
  hand,
  choice,
  thimble,
  session,
};

/// Overlay that must be answered before the stage.
enum class TrainingOver : std::uint8_t { none, paused, leaving, trouble, message };

/// Cover of a finger in a device: thresholds are measured with one of them.
struct Thimble {
  std::string_view word;  ///< in the record
  const char* name;       ///< tr() shows them
  const char* line;
};
inline constexpr std::array<Thimble, 4> kThimbles = {{
    {"stylus", toTranslate("Pen"), toTranslate("Held like a pencil.")},
    {"rigid thimble", toTranslate("Hard thimble"), toTranslate("The fingertip sits in a hard cup.")},
    {"soft thimble", toTranslate("Soft thimble"), toTranslate("The fingertip sits in rubber or foam.")},
    {"bare finger", toTranslate("Bare finger"), toTranslate("Skin on the device.")},
}};

struct TrainingView {
  TrainingStage stage = TrainingStage::sign_in;
  TrainingOver over = TrainingOver::none;
  std::string typed = {};
  bool leads_back = false;   ///< from the sign-in to the start page
  std::string notice = {};   ///< a sentence of the front desk or of the window
  std::string trouble = {};  ///< the failed action
  std::string message = {};  ///< the instructor's
  std::string code = {};     ///< code of the trainee who is signed in or about to be
  std::vector<Offer> offers = {};
  std::string device = {};  ///< name of the device that holds the finger
  bool by_mouse = false;
  double force_share = 1.0;  ///< share of the body's forces that the device can render (DevicesShown::stiffness_factor)
  double ratios_kept_to_n = 0.0;  ///< above this force places differ less than they do; 0: nowhere
  std::size_t focus = 0;
  const training::Session* session = nullptr;
  training::Moment now = {};
  bool waiting = false;  ///< for the body of the trial
  int picked = 0;
  bool said_long_ago = false;  ///< the session's last text is old
  // In place of `session`, where lumps are hidden.
  const training::LumpSession* lumps = nullptr;
  bool touched = false;   ///< a place was, that Here would name
  std::size_t named = 0;  ///< number of marks, from the first, that were named
  std::size_t marks = 0;
};

TrainingScreen makeTrainingScreen(const TrainingView& view);
/// The part of it for `view.lumps` (lump_screens.cpp).
TrainingScreen makeLumpScreen(const TrainingView& view);

/// All words of the screen, whatever they are for.
std::vector<std::string> wordsOf(const TrainingScreen& screen);

/// Shown while the body of the next trial is made.
inline constexpr const char* kOneMoment = toTranslate("One moment ...");

}  // namespace palpate::viewer
