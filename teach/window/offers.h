// What a trainee may do next, and what is suggested: test, practise, test again, be examined, come back after a week.
//
//   sittings and blocks of the record ─ TrainingPast ─ offersFor ─► Offer, one for each kind, one of them suggested
//
// Pure. The order is that of the published course: six practices between the two tests.
// Based on: Howell et al., BMC Medical Education 8:14, 2008.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "palpate/training/protocol.h"

namespace palpate::training {
class Store;
}

namespace palpate::viewer {

/// What the record says about a trainee.
struct TrainingPast {
  struct OfKind {
    int finished = 0;  ///< blocks
    bool interrupted = false;
    std::int64_t last_ms = 0;  ///< when the newest finished one ended
  };
  std::map<training::SittingKind, OfKind> kinds;
  bool empty() const { return kinds.empty(); }
  OfKind of(training::SittingKind kind) const;
};

TrainingPast trainingPastOf(training::Store& store, const std::string& trainee);

struct Offer {
  training::SittingKind kind = training::SittingKind::practice;
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
std::string nameOfKind(training::SittingKind kind);

}  // namespace palpate::viewer
