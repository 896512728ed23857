// The commands of palpate-teach; palpate-class has them too.
#pragma once

#include "cli/kit/options.h"

namespace palpate::app {

void addTeachFamily(Command& app);

void addResultsCommand(Command& train);

}  // namespace palpate::app
