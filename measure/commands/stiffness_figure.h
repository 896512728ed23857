// Measured forces of places with the forms that were fitted to them, as a picture.
#pragma once

#include "palpate/measure/place_stiffness.h"
#include "report/charts/figure.h"

namespace palpate::app {

/// A panel a place; of one that was refused the rows alone.
figures::Figure placeStiffnessFigure(const measure::PlaceFits& fits);

}  // namespace palpate::app
