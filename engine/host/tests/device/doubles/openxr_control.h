// What a test tells the double of an OpenXR runtime, and sees of it. One thread, no clock.
#pragma once

#include <array>
#include <cstdint>

namespace palpate::doubles {

struct OpenXrControl {
  // What there is.
  bool runtime = true;
  bool headless = true;
  bool timespec = true;
  bool starts = true;
  bool headset = true;
  // What happens.
  int questions_before_ready = 0;   ///< xrPollEvent is asked so often in vain before the session is ready
  std::int32_t next_state = 0;      ///< of the session, said at the next question; 0: none
  std::int64_t centred_in_ns = -1;  ///< the next question is answered with a space LOCAL that moves then; -1: none
  bool instance_lost = false;       ///< said at the next question
  std::int32_t locating = 0;        ///< result of every xrLocateSpace
  std::uint64_t flags = 0xf;        ///< what is valid (1, 2) and tracked (4, 8)
  std::array<float, 3> place_m{};   ///< of the head
  // What was asked of it.
  int instances = 0;  ///< that live
  int begun = 0;
  int ended = 0;
  int located = 0;
  int questions = 0;  ///< xrPollEvent
  int breaches = 0;   ///< calls that the specification does not allow
  const char* last_breach = "";
};

/// Exported under the name "palpateOpenXrDouble".
using OpenXrControlFunction = OpenXrControl*();

}  // namespace palpate::doubles
