// Hints follow each other: one is shown until what it says was done.
#pragma once

#include "apps/viewer/session.h"
#include "palpate/view/input.h"

namespace palpate::viewer {

/// Goes to the next hint when the command is what the present one asks for.
void countHint(const view::Command& command, Session& session);

}  // namespace palpate::viewer
