// The height of the person whom the tables of this room describe.
#pragma once

namespace palpate::body {

/// mm. Skin and bones are built at this stature and scaled as a whole to the one that is asked for.
inline constexpr double kTableStatureMm = 1750.0;

}  // namespace palpate::body
