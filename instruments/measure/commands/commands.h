// The commands of palpate-measure.
#pragma once

#include "cli/kit/options.h"

namespace palpate::app {

/// With `run`, whose window measures photographs too.
void addMeasureFamily(Command& app);

void addMeasureCommand(Command& app);

// For `palpate measure`.
void addMeasureAverageCommand(Command& measure);
void addMeasureDotsCommand(Command& measure);
void addMeasureSessionCommand(Command& measure);
void addMeasureStencilCommand(Command& measure);
void addMeasureStiffnessCommand(Command& measure);
void addMeasureSynthesizeCommand(Command& measure);

}  // namespace palpate::app
