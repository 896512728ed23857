// Reading users' text: whole files with a size limit, numbers without a locale, letters of UTF-8.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace palpate {

/// The whole file. Throws Error naming the file when it is missing, a folder, unreadable, or longer than `max_bytes` or
/// than memory can be addressed.
std::string readFile(const std::filesystem::path& file, std::uint64_t max_bytes);

/// Writes the whole file, replacing what was there. Throws Error naming the file when it cannot.
void writeFile(const std::filesystem::path& file, std::string_view content);

/// The number that fills the whole text, blanks around it allowed, or nothing. Never reads the locale. `inf` and `nan`
/// are read as such: the caller decides whether they are wanted.
std::optional<double> parseNumber(std::string_view text);

/// The same without blanks around it and without a plus; allocates nothing. False where the text is not a number.
bool readNumber(std::string_view text, double& value) noexcept;

/// The text without blanks, tabs and line ends at both ends.
std::string_view trimmed(std::string_view text);

/// With A to Z as a to z; other bytes, letters of UTF-8 among them, stay. Never reads the locale.
std::string inSmallLetters(std::string_view text);

/// The fields between separators, each trimmed; "a,,b" has three fields, "" has one.
std::vector<std::string_view> split(std::string_view text, char separator);

/// The text behind a byte order mark of UTF-8.
std::string_view withoutByteOrderMark(std::string_view text);

/// Whether the text begins with a byte order mark of UTF-16, of either byte order.
bool isUtf16(std::string_view text) noexcept;

/// Appends the letter as UTF-8; at most U+10FFFF.
void appendLetter(std::string& text, char32_t letter);

/// Length in bytes of the letter of UTF-8 at the begin of the text; 0: it begins with none. By RFC 3629: no overlong
/// forms, no surrogates, nothing beyond U+10FFFF.
std::size_t letterBytes(std::string_view text) noexcept;

/// The text with U+FFFD for each byte outside a letter. Names of files are any bytes; JSON, SVG and renderers of
/// letters accept UTF-8 only.
std::string wellFormed(std::string_view text);

}  // namespace palpate
