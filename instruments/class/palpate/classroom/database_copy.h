// A snapshot of a class's PostgreSQL as records that everything which reads a station's file reads too: lists, exports,
// verification, reports.
//
//   PostgreSQL ─ one snapshot ─► Store in memory ─► results, reports
#pragma once

#include <string>

#include "palpate/training/records/store.h"

namespace palpate::classroom {

/// The collector may go on meanwhile. The copy is called "database NAME", never by the address, which may hold a
/// password. Throws DatabaseAway, or Error for a database that holds no training records of this version; nothing is
/// created or migrated there.
training::Store copyOfDatabase(const std::string& address);

}  // namespace palpate::classroom
