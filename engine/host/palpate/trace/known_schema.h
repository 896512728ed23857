// Which tables a database may have: those that this program makes, word for word. A stranger's file may bring a view in
// place of a table that never ends, a column that is computed, a table of another module; none of it is asked anything.
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "palpate/trace/database.h"

namespace palpate::trace {

/// CREATE statements without comments, with single blanks.
using KnownSchema = std::set<std::string, std::less<>>;

/// The schema of an empty database after these statements.
KnownSchema schemaMadeBy(const std::string& statements);

/// Whether the statement is one of these, whatever its blanks and comments are.
bool isKnown(const KnownSchema& known, std::string_view statement);

/// Throws Error naming the first table, index, view or trigger of the file that is not `known`. `what` the file should
/// be: "a recording". Ask a file nothing else before.
void requireKnownSchema(Database& database, const KnownSchema& known, std::string_view what);

}  // namespace palpate::trace
