// Any displacement profile of the dissertation, or the user's own, ready to be evaluated vertex by vertex.
//
// `deform`'s fast path does not come here: it has the default profile (profile.h) in its kernels. This is the one
// of the general displacement, and what draws the curves. Made once from ProfileSettings; a value costs 5 to 30 ns.
#pragma once

#include <vector>

#include "palpate/tissue/profile_settings.h"

namespace palpate::tissue {

/// A profile and its derivative by q.
struct ProfilePoint {
  double value = 0.0;
  double slope = 0.0;
};

/// Immutable; any number of threads.
class ProfileCurve {
 public:
  /// Throws Error for settings that describe no curve: less than 2 table entries, widths that are not positive, knots
  /// that are not a profile (checkProfileKnots).
  explicit ProfileCurve(const ProfileSettings& settings = {});

  /// At location ratio q >= 0: 1 at q = 0, {0, 0} from q = 1 on and for NaN. Two Gaussians and a user's curve may go
  /// below 0 (a bulge). The slope of a table is that of the straight line between its entries, for either lookup: the
  /// steps of the nearest one are not meant to be seen in the shading. No allocation.
  ProfilePoint at(double q) const noexcept;

 private:
  ProfilePoint unfinished(double q) const noexcept;
  ProfilePoint tableAt(double q) const noexcept;
  ProfilePoint userAt(double q) const noexcept;
  ProfilePoint finished(const ProfilePoint& point, double q) const noexcept;
  void fillTable();

  ProfileSettings settings_;
  double rest_ = 0.0;  // of the unfinished curve at the rim, to be lowered
  std::vector<double> table_;
  std::vector<double> knot_slopes_;
};

}  // namespace palpate::tissue
