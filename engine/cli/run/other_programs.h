// Palpate's other programs: those that are installed, and those that ./run is building meanwhile.
//
//   tools/build-later ─► build/later.log, named by PALPATE_BUILD_LOG ─► OtherPrograms::now ─► the start page
#pragma once

#include <filesystem>
#include <string_view>

#include "palpate/base/stopwatch.h"
#include "view/viewer/state/activities.h"

namespace palpate::app {

/// Used on the display's thread.
class OtherPrograms {
 public:
  /// Activities of this window itself.
  struct Own {
    bool measuring = false;
    bool classes = false;
  };
  explicit OtherPrograms(const Own& own);
  /// Looks at the files twice a second at most.
  const viewer::Activities& now();

 private:
  viewer::ActivityState find(bool own, std::string_view family) const;

  Own own_;
  std::filesystem::path build_log_;  ///< empty: nothing is being built
  viewer::Activities activities_ = {};
  Clock::time_point looked_ = {};
};

/// The family's progress in the log. Missing where its build has failed.
viewer::ActivityState stateOfBuild(std::string_view log, std::string_view family);

}  // namespace palpate::app
