// Figures that a program gets as JSON, for people: described once.
#pragma once

#include <string>

#include "palpate/base/json.h"

namespace palpate::study {

/// A line for each member of an object, by its key; figures within a figure stand in its line, or indented below it
/// where they have some of their own. What was skipped is told by the reason. Fractions have four digits.
std::string figuresText(const Json& figures);

}  // namespace palpate::study
