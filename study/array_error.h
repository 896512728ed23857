// How far the stored half Gaussian is from the curve (Figure 4.9).
#pragma once

#include "palpate/tissue/profile_curve.h"

namespace palpate::study {

/// The largest error in mm at the dissertation's deepest press of 10 mm.
double worstArrayError(int entries, tissue::TableLookup lookup);

/// The array of (4.3), with the step at the rim that the text has.
tissue::ProfileCurve arrayProfile(int entries, tissue::TableLookup lookup);
/// The closed form of the same curve.
tissue::ProfileCurve closedProfile();

}  // namespace palpate::study
