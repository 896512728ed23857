// A number that a fit found, and how sure it is.
#pragma once

#include <string_view>

namespace palpate::tissue {

struct FittedNumber {
  std::string_view name;
  double value = 0.0;
  double standard_error = 0.0;  ///< NaN: too few rows to tell; 0: at the end of its range, or not asked for
  bool at_end = false;          ///< of its range: what the rows want may lie beyond
};

}  // namespace palpate::tissue
