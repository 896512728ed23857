// The elements of a report's page. Every text that is not ours passes escapedText() once, on its way into one of them;
// nothing else makes markup.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "report/charts/figure.h"
#include "report/recording/recording_report.h"

namespace palpate::app {

/// Escapes for XML, between tags and in quotes.
std::string escapedText(std::string_view text);

std::string htmlElement(std::string_view tag, std::string_view text);

/// A heading of a section, and a paragraph, each with a line end.
std::string headingHtml(std::string_view text);
std::string paragraphHtml(std::string_view text);

using Cells = std::vector<std::string>;

/// `kind`: numbers (all columns but the first are right-aligned) or words. Without headings where there are none.
std::string tableOf(std::string_view kind, const Cells& headings, const std::vector<Cells>& rows);

/// A row of facts; empty without a value.
std::string factRow(std::string_view name, std::string_view value);

/// The picture inside the page; `alternative` describes it for those who cannot see it.
std::string figureHtml(std::string_view id, const figures::Figure& figure, std::string_view alternative,
                       std::string_view caption);

/// All up to the heading, with the look of every report; kPageEnd closes it.
std::string pageBegin(std::string_view name);
inline constexpr std::string_view kPageEnd = "</main>\n</body>\n</html>\n";
/// The main results, in sentences.
std::string summaryHtml(const std::vector<std::string>& sentences);

/// The section with what the terms of a report mean.
std::string definitionsHtml(const std::vector<std::pair<std::string, std::string>>& meanings);

// The tables of a recording's report, each with its heading; empty without rows.

std::string sizesTable(const RecordingReport& report);
std::string phasesSection(const RecordingReport& report);
std::string contactsSection(const RecordingReport& report);
std::string safetySection(const RecordingReport& report);
std::string servoSection(const RecordingReport& report);
std::string eventsSection(const RecordingReport& report);

}  // namespace palpate::app
