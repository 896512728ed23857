// The study of the errata as text, JSON, Markdown and CSV.
#pragma once

#include <filesystem>
#include <string>

#include "dissertation/errata/errata_study.h"
#include "report/page/text_table.h"

namespace palpate::study {

/// The corrected runs, all switches together, then a row an erratum, as all reports show it.
TextTable tableOf(const ErrataEffects& effects);
/// What its columns mean.
std::string errataLegend();

std::string errataText(const ErrataEffects& effects);
/// One object of three lists: "corrected" and "all_literal" with an object for each contact source and tree, "errata"
/// with one for each erratum.
std::string errataJson(const ErrataEffects& effects);
/// errata.md, errata.csv and errata.json. Throws Error naming the file.
void writeErrata(const ErrataEffects& effects, const std::filesystem::path& folder);

}  // namespace palpate::study
