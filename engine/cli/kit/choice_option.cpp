#include "cli/kit/choice_option.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>

#include "palpate/base/language.h"
#include "palpate/base/nearest_name.h"

namespace palpate::app {

namespace {

std::string joinChoices(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, "|")); }

/// Ignores case.
bool isSameChoice(const std::string& one, const std::string& other) {
  return std::ranges::equal(one, other,
                            [](unsigned char a, unsigned char b) { return std::tolower(a) == std::tolower(b); });
}

}  // namespace

std::string faultOfChoice(const std::string& wanted, const std::vector<std::string>& names) {
  if (std::find(names.begin(), names.end(), wanted) != names.end()) return {};
  const std::string nearest = nearestName(wanted, names);
  const std::string hint = nearest.empty() ? nearest : fmt::format("; did you mean '{}'?", nearest);
  return fmt::format("'{}' is not one of {}{}", oneLine(wanted), fmt::join(names, "|"), hint);
}

Option* restrictTo(const std::vector<std::string>& names, Option* option) {
  option->check([names](const std::string& wanted) { return faultOfChoice(wanted, names); });
  return option->type_name(joinChoices(names));
}

Option* addIndexedChoice(Command& command, const std::string& option, const std::vector<std::string>& names,
                         std::optional<std::size_t> standard, const std::function<void(std::size_t)>& choose,
                         const std::string& help) {
  const auto read = [names, option, choose](const std::string& wanted) {
    const auto chosen =
        std::ranges::find_if(names, [&](const std::string& name) { return isSameChoice(name, wanted); });
    if (chosen == names.end()) throw UsageError(option, faultOfChoice(wanted, names));
    choose(static_cast<std::size_t>(chosen - names.begin()));
  };
  const std::string shown = standard ? "; default " + names[*standard] : std::string();
  return command.add_option_function(option, read, help + shown)->type_name(joinChoices(names));
}

Option* addLanguage(Command& command, std::string& code) {
  std::vector<std::string> codes;
  for (const Language& language : languages()) codes.emplace_back(language.code);
  return restrictTo(codes, command.add_option("--language", code,
                                              "Language of the interface and of reports (default: the system's)"));
}

}  // namespace palpate::app
