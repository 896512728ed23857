// The commands of palpate-report.
#pragma once

#include "cli/kit/options.h"

namespace palpate::app {

void addReportFamily(Command& app);

void addMapCommand(Command& body);
void addPlotCommand(Command& recording);

}  // namespace palpate::app
