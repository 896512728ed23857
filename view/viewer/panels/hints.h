// Hints follow each other: one is shown until what it says was done. Pure.
//
//   Command ─ countHint ─► number of the present hint ─ hintText ─► the words over the picture (notices.cpp)
#pragma once

#include <string_view>

#include "palpate/window/input.h"

namespace palpate::viewer {

/// The words of hint number `i`, from 0; empty after the last.
std::string_view hintText(int i);

/// Goes to the next hint when the command is what the present one asks for; after the last, `wanted` becomes false.
void countHint(const window::Command& command, int& hint, bool& wanted);

}  // namespace palpate::viewer
