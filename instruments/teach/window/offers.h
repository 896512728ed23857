// Offers of the next session, and which is suggested: test, practise, test again, be examined, come back after a week.
//
//   sessions and blocks of the record ─ TrainingPast ─ offersFor ─► Offer, one for each kind, one of them suggested
//
// Pure. The order is that of the published course: six practices between the two tests.
// Based on: Howell et al., BMC Medical Education 8:14, 2008.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "palpate/training/protocol.h"
#include "palpate/training/session/session.h"

namespace palpate::training {
class Store;
}

namespace palpate::viewer {

/// A trainee's past in the record.
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

TrainingPast loadTrainingPast(training::Store& store, const std::string& trainee);

struct Offer {
  training::SessionKind kind = training::SessionKind::practice;
  std::string name;
  std::string line;  ///< describes it, or why it is not available yet
  bool enabled = true;
  bool suggested = false;
};

/// Practices of the published course between its two tests.
inline constexpr int kPracticesOfCourse = 6;

/// In the order of a course; exactly one is suggested.
std::vector<Offer> offersFor(const TrainingPast& past, const training::Protocol& protocol, std::int64_t now_ms);

/// "Practice", "Test before practice".
std::string nameOfKind(training::SessionKind kind);

}  // namespace palpate::viewer
