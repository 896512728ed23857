// Lumps at random in the shipped layers: what loops, benchmarks and the hunt put under a finger.
#pragma once

#include "palpate/base/random.h"
#include "palpate/contact/lump_force.h"
#include "palpate/tissue/library_fields.h"

namespace palpate::lab {

/// Layers of any place that has room for lumps: bone 20 to 60 mm deep, a tenth to a half of it fat.
tissue::LumpPlace randomLumpPlace(Random& random);

/// Any lump that fits there: 2 to 20 mm, flat or tall, to 12 mm under the skin's layer, 0.2 to 100 times as stiff as
/// its layer, sharp or soft at its edge. On a skin of this stiffness the force over it grows by kStiffestTissue at
/// most, as scene::placedLumps keeps it.
contact::Lump randomLump(const tissue::LumpPlace& place, const Vec3& foot, const Vec3& axis, double skin_n_per_mm,
                         Random& random);

/// Hangs it on a spring of 0.02 to 0.3 N/mm with up to 0.05 N of dry friction.
void loosen(contact::Lump& lump, Random& random);

/// The stiffest lump that a scene can have on a skin of this stiffness: a hard ball of 20 mm right under the skin's
/// layer, as steep as the bound on all lumps allows.
contact::Lump stiffestLump(const Vec3& foot, const Vec3& axis, double skin_n_per_mm);

/// U times a factor after which nothing of it is steeper than that bound; `stretch`: also where it was less steep.
void boundSlope(contact::Lump& lump, double skin_n_per_mm, bool stretch);

}  // namespace palpate::lab
