// The study of the errata as text, JSON, Markdown and CSV.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/errata/errata_study.h"
#include "study/page/text_table.h"

namespace palpate::study {

/// A row an erratum, as all reports show it.
TextTable tableOf(const std::vector<ErratumEffect>& effects);
/// What its columns mean.
std::string errataLegend();

std::string errataText(const std::vector<ErratumEffect>& effects);
/// One object: "errata", a list with one object each; "all_literal", the effect of every switch together.
std::string errataJson(const std::vector<ErratumEffect>& effects);
/// errata.md, errata.csv and errata.json. Throws Error naming the file.
void writeErrata(const std::vector<ErratumEffect>& effects, const std::filesystem::path& folder);

}  // namespace palpate::study
