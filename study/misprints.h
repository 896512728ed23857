// Printed numbers that are known to be wrong, each with the erratum that says so.
#pragma once

#include <span>
#include <string_view>

#include "palpate/base/fidelity.h"

namespace palpate::study {

struct Misprint {
  std::string_view where;
  std::string_view what;
  std::string_view printed;
  Erratum erratum;
  std::string_view reason;
};

std::span<const Misprint> misprints();

}  // namespace palpate::study
