// The commands of palpate-study, with those of solve and lab.
#pragma once

#include "cli/kit/options.h"

namespace palpate::app {

void addStudyFamily(Command& app);

void addCredibilityCommand(Command& study);
void addPartitionCommand(Command& study);

}  // namespace palpate::app
