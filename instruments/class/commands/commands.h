// The commands of palpate-class.
#pragma once

#include "cli/kit/options.h"

namespace palpate::app {

/// `palpate class`, and the commands of training with a class over the network.
void addClassFamily(Command& app);

void addClassCommand(Command& app);

}  // namespace palpate::app
