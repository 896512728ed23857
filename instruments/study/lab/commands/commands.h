// The commands that measure and hunt, for palpate-study.
#pragma once

#include "cli/kit/options.h"

namespace palpate::app {

void addHuntCommand(Command& study);
void addBenchCommand(Command& study);
void addLumpLoopsCommand(Command& lump);

// For `palpate study bench`.
void addBenchBatchCommand(Command& bench);
void addBenchContactCommand(Command& bench);
void addBenchDeformCommand(Command& bench);
void addBenchEditCommand(Command& bench);
void addBenchFrameCommand(Command& bench);
void addBenchLoadCommand(Command& bench);
void addBenchLumpCommand(Command& bench);
void addBenchPartitionCommand(Command& bench);
void addBenchServoCommand(Command& bench);
void addBenchRecordingCommand(Command& bench);

}  // namespace palpate::app
