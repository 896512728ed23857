// A flat rectangular probe pressed a little into layered tissue: the stiffness of the whole probe. Linear, without
// friction (a probe has gel under it), 8-node boxes; one quarter represents the whole.
//
// Under the layers lies a plane of bone, or the bone of a limb: a cylinder along the probe's long side.
#pragma once

#include "palpate/tissue/layered_table.h"

namespace palpate::elements {

struct ProbeSettings {
  double length_mm = 40.0;  ///< along the bone
  double width_mm = 9.0;    ///< across it
  /// 0: a plane. Otherwise the deepest layer continues around the bone down to its middle, and to each side as far as
  /// the limb reaches there; those sides are free.
  double bone_radius_mm = 0.0;
  double half_length_mm = 100.0;  ///< block's extent to each side of the probe's middle; its ends are held
  double fineness = 1.0;          ///< 2: elements half as large
};

/// N/mm. Throws Error for sizes that make no sense, and where the equations are not solved.
double probeStiffness(const tissue::LayerStack& stack, const ProbeSettings& settings);

}  // namespace palpate::elements
