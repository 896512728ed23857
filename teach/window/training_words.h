// From where a trainee is to what the screen says: words, buttons and marks of every screen of the training window.
//
//   TrainingView (front desk or session, and what was typed and picked) ─ screenOf ─► TrainingScreen
//
// Pure. What a test hides never gets this far: of the hidden place it reads nothing but, in feedback, which site it
// was.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "palpate/base/language.h"
#include "palpate/training/protocol.h"
#include "palpate/training/session/session.h"
#include "teach/window/training_screen.h"

namespace palpate::training {
class Store;
}

namespace palpate::viewer {

// What a trainee may do next, and what is suggested: test, practise, test again, be examined, come back after a week.
//
//   sessions and blocks of the record ─ TrainingPast ─ offersFor ─► Offer, one for each kind, one of them suggested
//
// Pure. The order is that of the published course: six practices between the two tests.
// Based on: Howell et al., BMC Medical Education 8:14, 2008.

/// What the record says about a trainee.
struct TrainingPast {
  struct OfKind {
    int finished = 0;  ///< blocks
    bool interrupted = false;
    std::int64_t last_ms = 0;  ///< when the newest finished one ended
  };
  std::map<training::SessionKind, OfKind> kinds;
  bool empty() const { return kinds.empty(); }
  OfKind of(training::SessionKind kind) const;
};

TrainingPast trainingPastOf(training::Store& store, const std::string& trainee);

struct Offer {
  training::SessionKind kind = training::SessionKind::practice;
  std::string name;
  std::string line;  ///< what it is, or why not yet
  bool enabled = true;
  bool suggested = false;
};

/// Practices of the published course between its two tests.
inline constexpr int kPracticesOfCourse = 6;

/// In the order of a course; exactly one is suggested.
std::vector<Offer> offersFor(const TrainingPast& past, const training::Protocol& protocol, std::int64_t now_ms);

/// "Practice", "Test before practice".
std::string nameOfKind(training::SessionKind kind);

enum class TrainingStage : std::uint8_t {
  sign_in,
  new_code,  ///< nobody has signed in with it here
  own_code,  ///< one was made up, to be written down
  consent,
  hand,
  choice,
  thimble,
  session,
};

/// What lies over a stage and is answered first.
enum class TrainingOver : std::uint8_t { none, paused, leaving, trouble, message };

/// What a finger that a device holds wears: thresholds belong to it.
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
  std::string trouble = {};  ///< what could not be done
  std::string message = {};  ///< of the instructor
  std::string code = {};     ///< of who is signed in or about to be
  std::vector<Offer> offers = {};
  std::string device = {};  ///< that holds the finger, in words
  bool by_mouse = false;
  double force_share = 1.0;       ///< of the body's forces, what the device can render (DevicesShown::stiffness_factor)
  double ratios_kept_to_n = 0.0;  ///< above this force places differ less than they do; 0: nowhere
  std::size_t focus = 0;
  const training::Session* session = nullptr;
  training::Moment now = {};
  bool waiting = false;  ///< for the body of the trial
  int picked = 0;
  bool said_long_ago = false;  ///< what the session said last
};

TrainingScreen screenOf(const TrainingView& view);

/// All words of the screen, whatever they are for.
std::vector<std::string> wordsOf(const TrainingScreen& screen);

/// Said while the body of the next trial is made.
inline constexpr const char* kOneMoment = toTranslate("One moment ...");

}  // namespace palpate::viewer
