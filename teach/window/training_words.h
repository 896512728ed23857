// From where a trainee is to what the screen says: words, buttons and marks of every screen of the training window.
//
//   TrainingView (front desk or sitting, and what was typed and picked) ─ screenOf ─► TrainingScreen
//
// Pure. What a test hides never gets this far: of the hidden place it reads nothing but, in feedback, which site it
// was.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "palpate/training/sitting.h"
#include "teach/window/offers.h"
#include "teach/window/training_screen.h"

namespace palpate::viewer {

enum class TrainingStage : std::uint8_t {
  sign_in,
  new_code,  ///< nobody has signed in with it here
  own_code,  ///< one was made up, to be written down
  consent,
  hand,
  choice,
  thimble,
  sitting,
};

/// What lies over a stage and is answered first.
enum class TrainingOver : std::uint8_t { none, paused, leaving, trouble, message };

/// What a finger that a device holds wears: thresholds belong to it.
struct Thimble {
  std::string_view word;  ///< in the record
  std::string_view name;
  std::string_view line;
};
inline constexpr std::array<Thimble, 4> kThimbles = {{
    {"stylus", "Pen", "Held like a pencil."},
    {"rigid thimble", "Hard thimble", "The fingertip sits in a hard cup."},
    {"soft thimble", "Soft thimble", "The fingertip sits in rubber or foam."},
    {"bare finger", "Bare finger", "Skin on the device."},
}};

struct TrainingView {
  TrainingStage stage = TrainingStage::sign_in;
  TrainingOver over = TrainingOver::none;
  std::string typed = {};
  std::string notice = {};   ///< a sentence of the front desk or of the window
  std::string trouble = {};  ///< what could not be done
  std::string message = {};  ///< of the instructor
  std::string code = {};     ///< of who is signed in or about to be
  std::vector<Offer> offers = {};
  std::string device = {};  ///< that holds the finger, in words
  bool by_mouse = false;
  double force_share = 1.0;       ///< of the body's forces, what the device can render (DevicesShown::stiffness_factor)
  double ratios_kept_to_n = 0.0;  ///< above this force places differ less than they do; 0: nowhere
  std::size_t focus = 0;
  const training::Sitting* sitting = nullptr;
  training::Moment now = {};
  bool waiting = false;  ///< for the body of the trial
  int picked = 0;
  bool said_long_ago = false;  ///< what the sitting said last
};

TrainingScreen screenOf(const TrainingView& view);

/// Said while the body of the next trial is made.
inline constexpr const char* kOneMoment = "One moment ...";

}  // namespace palpate::viewer
