// The profile as printed: the half Gaussian through 700 stored entries, nearest lookup, with its step at the rim.
//
// Based on: Ji, dissertation 2008, (4.2), (4.3); E18.
#pragma once

#include "palpate/base/fidelity.h"
#include "palpate/tissue/profile_settings.h"

namespace palpate::tissue {

/// These settings with what the fidelity takes literally. // E18
inline ProfileSettings withFidelity(ProfileSettings settings, const Fidelity& fidelity) {
  if (!fidelity.literal(18)) return settings;
  settings.rim = ProfileRim::step;
  if (settings.kind == ProfileKind::half_gaussian) settings.kind = ProfileKind::table;
  return settings;
}

}  // namespace palpate::tissue
