// The catalogue is looked up under LANGUAGE, which libintl honours in every locale but "C"; the locale stays C.UTF-8,
// so that numbers are read and written as ever, unless a user requests another decimal sign.
#include "palpate/base/language.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <system_error>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/base/nearest_name.h"
#include "palpate/base/path_text.h"
#include "palpate/base/system/process.h"
#include "palpate/base/text.h"

namespace palpate {

namespace {

constexpr std::array kLanguages = {Language{"en", "English", '.', ","}, Language{"de", "Deutsch", ',', "."},
                                   Language{"es", "Espa\xc3\xb1ol", ',', "\xe2\x80\xaf"}};  // a narrow space

std::atomic<const Language*> in_use = &kLanguages.front();

const Language* findLanguage(std::string_view code) {
  const auto* found = std::ranges::find(kLanguages, code, &Language::code);
  return found == kLanguages.end() ? nullptr : found;
}

bool isC(std::string_view locale) { return locale == "C" || locale == "POSIX"; }

/// The locale of messages: the first that is set and not empty (POSIX.1-2017, section 8.2).
std::string localeOfTheSystem() {
  for (const char* name : {"LC_ALL", "LC_MESSAGES", "LANG"}) {
    if (std::string locale = system::variable(name); !locale.empty()) return locale;
  }
  return "C";
}

/// Follows GNU gettext (its manual, "The LANGUAGE variable"): LANGUAGE lists languages in the order of one's liking and
/// replaces the locale's, but says nothing in the locale "C"; an entry "C" ends the list. "de" of "de_AT.UTF-8".
const Language& ofTheSystem() {
  const std::string locale = localeOfTheSystem();
  const std::string list = isC(locale) ? "" : system::variable("LANGUAGE");
  for (const std::string_view wanted : split(list.empty() ? locale : list, ':')) {
    const std::string_view code = wanted.substr(0, wanted.find_first_of("_.@"));
    if (isC(code)) break;
    if (const Language* known = findLanguage(code)) return *known;
  }
  return kLanguages.front();
}

std::filesystem::path ownCatalogues() {
  const std::filesystem::path programs = system::ownProgram().parent_path();
  const std::filesystem::path installed = (programs / pathOf("../share/locale")).lexically_normal();
  std::error_code error;
  return std::filesystem::is_directory(programs / "share/locale", error) ? programs / "share/locale" : installed;
}

std::vector<std::string> codes() {
  std::vector<std::string> all;
  for (const Language& known : kLanguages) all.emplace_back(known.code);
  return all;
}

}  // namespace

std::span<const Language> languages() { return kLanguages; }

void useLanguage(std::string_view code, const std::filesystem::path& folder) {
  const Language* wanted = code.empty() ? &ofTheSystem() : findLanguage(code);
  if (wanted == nullptr) throw Error(unknownName("language", std::string(code), "", codes()));
  in_use = wanted;
  system::useCatalogue(folder.empty() ? ownCatalogues() : folder, std::string(wanted->code));
}

const Language& language() noexcept { return *in_use; }

const char* tr(const char* english) noexcept {
  // The empty text is the catalogue's own header.
  return language().code == "en" || *english == '\0' ? english : system::translate(english);
}

const char* trn(const char* one, const char* many, std::size_t count) noexcept {
  if (language().code == "en") return count == 1 ? one : many;
  return system::translate(one, many, count);
}

std::string formattedIfFit(const char* format, fmt::format_args values) {
  try {
    return fmt::vformat(format, values);
  } catch (const fmt::format_error&) {
    return {};
  }
}

}  // namespace palpate
