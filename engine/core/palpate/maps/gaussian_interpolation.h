// Gaussian radial interpolation (GRI): a smooth field through scattered measurements, over a base outside their reach.
//
// Each key point i has an effect level a_i at the queried place, 1 at the key and 0 from the effect radius on. Alone it
// gives V_i = base (1 - a_i) + v_i a_i; several are blended with weights w_i = a_i / (1 - a_i). That is (5.16)
// divided by the product of all (1 - a_j): the same numbers in O(n) instead of O(n^2), with no 0/0 (E26, E27).
// Based on: Ji, dissertation 2008, section 5.2.
#pragma once

#include "palpate/base/gaussian.h"

namespace palpate::maps {

/// Effect level in [0, 1] of a key point at this distance in the map plane (E28: the effect radius, not the diameter);
/// 0.0021 at the radius, 0 beyond. A radius that is not positive reaches nothing but the key itself.
inline double effectLevel(double distance_mm, double effect_radius_mm) {
  if (distance_mm == 0.0) return 1.0;
  return distance_mm <= effect_radius_mm ? halfGaussian(distance_mm / effect_radius_mm) : 0.0;
}

/// Collects the key points of one place. Value is double or a fixed-size vector (LogTensor).
template <class Value>
class GaussianBlend {
 public:
  explicit GaussianBlend(const Value& base) : base_(base), sum_(base * 0.0), sum_at_keys_(base * 0.0) {}

  /// Levels that are not above 0 (NaN included) add nothing.
  void add(double level, const Value& value) {
    if (level >= 1.0) {
      sum_at_keys_ += value;
      keys_here_ += 1.0;
    } else if (level > 0.0) {
      const double weight = level / (1.0 - level);
      sum_ += weight * Value(base_ * (1.0 - level) + value * level);
      weight_ += weight;
    }
  }

  /// On a key: its value, or the mean of those that coincide there. Out of all reach: the base. Else the blend (E27).
  Value result() const {
    if (keys_here_ > 0.0) return sum_at_keys_ / keys_here_;
    return weight_ > 0.0 ? Value(sum_ / weight_) : base_;
  }

 private:
  Value base_;
  Value sum_;
  Value sum_at_keys_;
  double weight_ = 0.0;
  double keys_here_ = 0.0;
};

}  // namespace palpate::maps
