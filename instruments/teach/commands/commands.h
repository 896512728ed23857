// The commands of palpate-teach.
#pragma once

#include "cli/kit/options.h"

namespace palpate::app {

void addTeachFamily(Command& app);

void addClassCommand(Command& app);
void addResultsCommand(Command& train);

}  // namespace palpate::app
