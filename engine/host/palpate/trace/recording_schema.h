// The content of a recording file: an SQLite database of this application. docs/reference/recordings.md describes its
// tables.
#pragma once

#include <string>

#include "palpate/trace/database.h"

namespace palpate::trace {

/// "Palp": the application id of the file.
inline constexpr std::int64_t kRecordingApplication = 0x50616c70;

/// Version of the tables and of the meaning of their texts; counts up when either changes. Files of every version stay
/// readable.
inline constexpr std::int64_t kRecordingVersion = 6;

/// Fingers of a recording: more than any rig has, so that a row that says more is damage.
inline constexpr std::int64_t kMaxFingers = 1000;

/// Makes the tables in an empty file. Throws Error.
void makeRecordingTables(Database& database);

/// The version of its tables. Throws Error for a file that is not a recording, for one of a later version, and for one
/// that holds anything but the tables and indexes of a recording (known_schema.h).
std::int64_t checkRecording(Database& database);

/// A scene's text as it is meant today, from a file of that version: before version 3 a scene that named no kind of
/// body meant the torso, and not the trunk; before version 4 one that named no tissue meant the half Gaussian, and not
/// layers; before version 5 layers pushed back on every finger as on one of 8 mm.
std::string sceneOfVersion(std::int64_t version, std::string scene);

}  // namespace palpate::trace
