// The commands about tissue and the lumps in it, for palpate-study.
#pragma once

#include "cli/kit/options.h"

namespace palpate::app {

void addTissueCommand(Command& app);
void addLumpCommand(Command& app);

// For `palpate lump` and `palpate tissue`.
void addLumpSolveCommand(Command& lump);
void addTissueLibraryCommand(Command& tissue);
void addTissueModuliCommand(Command& tissue);
void addTissueShowCommand(Command& tissue);
void addTissueSolveCommand(Command& tissue);
void addRealismCommand(Command& tissue);
void addFitForceCommand(Command& fit);
void addFitProfileCommand(Command& fit);

}  // namespace palpate::app
