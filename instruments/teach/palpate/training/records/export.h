// The records for others: tables, JSON, statements for a learning record store. Leaves out whatever would reveal trials
// to come, and remarks typed about a trainee.
//
//   RowTables ─ exportedRows ─► csvFiles, jsonText, xapiText ─► the caller writes them
#pragma once

#include <string>
#include <vector>

#include "palpate/base/csv.h"
#include "palpate/training/records/row_tables.h"

namespace palpate::training {

struct ExportedFile {
  std::string name;  ///< "trials.csv"
  std::string text;
};

/// All rows, as they may be seen outside: of blocks that go on no state and no seed, of instructors' messages no text.
std::vector<AnyRow> exportedRows(RowTables& rows);

/// One table per file, and data_dictionary.csv, which explains each column. RFC 4180. `kind` decides about texts that a
/// spreadsheet would run as formulas.
std::vector<ExportedFile> csvFiles(RowTables& rows, CsvText kind = CsvText::safe);

/// One object with a list for each table; trials have their visits in them.
std::string jsonText(RowTables& rows);

struct XapiSettings {
  std::string home_page = "https://palpate.example";  ///< for the accounts; never a mail address
};

/// A list of xAPI 1.0.3 statements, oldest first. Their ids are made of the rows': the same rows give the same text.
/// Based on: ADL, Experience API 1.0.3; ADL verbs; cmi5 (one of passed and failed for a session).
std::string xapiText(RowTables& rows, const XapiSettings& settings);

}  // namespace palpate::training
