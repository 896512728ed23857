// How much stiffer a lump makes its place: Eshelby's inclusion, and how that ends near skin, bone and stiffer layers.
#pragma once

#include <cstddef>
#include <vector>

#include "palpate/tissue/lump_energy.h"

namespace palpate::tissue {

/// Times the strain energy densities of the press without lump, kPa.
struct Hardening {
  double shear_kpa = 0.0;   ///< kappa_s mu
  double volume_kpa = 0.0;  ///< kappa_v lambda
};

/// kappa = (m - 1) / (1 + beta (m - 1)) with m the local ratio of moduli.
class Saturation {
 public:
  /// Both must have passed check(lump, stack).
  Saturation(const LumpShape& lump, const LayerStack& stack);

  /// 1 far from everything: the ball in an endless medium, nothing fitted; 0.1 at least.
  double sigma() const { return sigma_; }
  /// In a layer, at a share of the lump's half axes from its middle.
  Hardening at(std::size_t layer, double share) const;

 private:
  const LayerStack& stack_;
  double young_kpa_ = 0.0;
  double edge_ = 0.0;
  double sigma_ = 1.0;
};

}  // namespace palpate::tissue
