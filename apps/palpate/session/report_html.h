// The elements of a report's page. Every text that is not ours passes escapedText() once, on its way into one of them;
// nothing else makes markup.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "apps/palpate/session/session_report.h"

namespace palpate::app {

/// As XML may hold it between tags and in quotes.
std::string escapedText(std::string_view text);

std::string elementOf(std::string_view tag, std::string_view text);

using Cells = std::vector<std::string>;

/// `kind`: numbers (all columns but the first stand right) or words. Without headings where there are none.
std::string tableOf(std::string_view kind, const Cells& headings, const std::vector<Cells>& rows);

// The tables of the report, each with what stands above it; empty where there is nothing to tell.

std::string sizesTable(const SessionReport& report);
std::string phasesSection(const SessionReport& report);
std::string contactsSection(const SessionReport& report);
std::string safetySection(const SessionReport& report);
std::string servoSection(const SessionReport& report);
std::string eventsSection(const SessionReport& report);

}  // namespace palpate::app
