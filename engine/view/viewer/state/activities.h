// Activities on the start page that another program of Palpate may have.
#pragma once

#include <array>
#include <cstddef>

namespace palpate::viewer {

enum class Activity { training, measuring, classes };

struct ActivityState {
  enum class Kind {
    here,       ///< this window shows it
    elsewhere,  ///< another program has it, to which the window gives way
    being_built,
    missing,
  };
  Kind kind = Kind::missing;
  int done = 0;  ///< steps of its build, out of `of`; 0 of 0: unknown
  int of = 0;
};

/// One of each Activity.
using Activities = std::array<ActivityState, 3>;

constexpr const ActivityState& activityState(Activity activity, const Activities& activities) {
  return activities[static_cast<std::size_t>(activity)];
}

}  // namespace palpate::viewer
