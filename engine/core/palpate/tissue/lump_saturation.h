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

/// The layer of a depth under the skin; the last one for what is deeper.
std::size_t layerAt(const LayerStack& stack, double depth_mm);

/// How high tissue on the axis of a press is over its height at rest, 0.02 to 1, by w_s there: it keeps its volume and
/// is pressed flat.
double stretchAlongAxis(double shear_density);

/// kappa = (m - 1) / (1 + beta (m - 1)) with m the local ratio of moduli.
class Saturation {
 public:
  /// Both must have passed check(lump, stack).
  Saturation(const LumpShape& lump, const LayerStack& stack);

  /// How much of the lump in a layer relaxes: 1 far from everything, the ball in an endless medium with nothing fitted;
  /// 0.1 at least; more than 1 under a softer layer. `squeeze`: how high the tissue between skin and lump is under the
  /// press, over its height at rest.
  double sigma(std::size_t layer, double squeeze = 1.0) const;
  /// In a layer, at a share of the lump's half axes from its middle.
  Hardening at(std::size_t layer, double share, double sigma) const;

 private:
  struct Around {
    double skin_takes = 0.0;  ///< beside what bone would, at the skin
    double ease = 1.0;        ///< by bone and other layers
    double squeeze_power = 0.0;
  };

  const LayerStack& stack_;
  double young_kpa_ = 0.0;
  double edge_ = 0.0;
  double gap_radii_ = 0.0;  ///< from the skin layer to the top
  std::vector<Around> around_;
};

}  // namespace palpate::tissue
