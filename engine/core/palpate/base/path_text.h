// Texts of ours are UTF-8, and so are names of files in them: in scenes, recordings, messages, on the command line, at
// the C interface. Windows would take a plain std::string for the code page of its user.
#pragma once

#include <filesystem>
#include <string_view>

namespace palpate {

/// The file or folder that a text names. Never std::filesystem::path(text): that one is right by chance.
inline std::filesystem::path pathOf(std::string_view utf8) {
  return std::u8string_view(reinterpret_cast<const char8_t*>(utf8.data()), utf8.size());
}

/// The name and more, behind its extension: withEnding("a.session", "-wal").
inline std::filesystem::path withEnding(std::filesystem::path file, std::string_view ending) {
  file += pathOf(ending);
  return file;
}

}  // namespace palpate
