// Which samples of a replay can be proven, where a session lacks time: what a finger remembers from there is not known
// until it has rested (trace/session_rest.h).
//
//   events "trim", "cut" of the session ─► ReplayProof ─► compare this sample? forget before it?
#pragma once

#include <span>
#include <string>
#include <vector>

#include "palpate/trace/session_reader.h"
#include "palpate/trace/session_rest.h"

namespace palpate::engine {

class ReplayProof {
 public:
  explicit ReplayProof(trace::SessionReader& session);

  /// The samples of the next tick, before any of them is felt.
  void begin(std::span<const trace::Sample> recorded);
  /// True where a finger of which nothing is known begins to rest: it must be felt as one that has never touched.
  bool beginsAnew(const trace::Sample& recorded);
  /// Whether the sample must come out to the bit.
  bool proves(const trace::Sample& recorded) const { return fingers_[recorded.finger].known; }
  /// Whether the warning "too stiff" must, too: it counts a second of contact, also across time that is missing.
  bool provesWarnings(const trace::Sample& recorded) const { return fingers_[recorded.finger].counts_known; }

  /// What was not proven, in words; empty: everything was.
  std::vector<std::string> notes() const;
  std::uint64_t unproven() const;

 private:
  struct Finger {
    std::string name;
    bool known = true;
    bool counts_known = true;
    trace::RestWatch rest;
    std::uint64_t unproven = 0;
    std::uint64_t since = 0;  ///< tick of the first of them
  };
  void loseSight(const trace::SessionEvent& event);

  std::vector<Finger> fingers_;
  std::vector<trace::SessionEvent> events_;
  std::size_t next_ = 0;
  double ticks_per_s_;
};

}  // namespace palpate::engine
