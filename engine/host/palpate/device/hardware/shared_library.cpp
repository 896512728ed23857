#include "palpate/device/hardware/shared_library.h"

#include <utility>

#include "palpate/base/nearest_name.h"
#include "palpate/base/path_text.h"
#include "palpate/base/system/library.h"
#include "palpate/base/system/process.h"

namespace palpate::device {

namespace {

constexpr std::string_view kNotOpened = ": cannot open shared object file";
constexpr std::size_t kLongestWords = 400;

bool wasFound(const LibraryAttempt& attempt) {
  return !attempt.dependency.empty() || attempt.words.find(kNotOpened) == std::string::npos ||
         attempt.words.find("No such file") == std::string::npos;
}

}  // namespace

void* SharedLibrary::symbol(const char* name) const {
  return handle == nullptr ? nullptr : system::findSymbol(handle, name);
}

std::string missingDependency(std::string_view words, std::string_view wanted) {
  const std::size_t end = words.find(kNotOpened);
  if (end == std::string_view::npos) return {};
  const std::string_view named = words.substr(0, end);
  const auto file_of = [](std::string_view path) { return pathOf(path).filename(); };
  return file_of(named) == file_of(wanted) ? std::string() : std::string(named);
}

std::vector<std::string> namesToTry(const std::string& file, const char* variable, std::vector<std::string> usual) {
  if (!file.empty()) return {file};
  if (std::string said = system::variable(variable); !said.empty()) return {std::move(said)};
  return usual;
}

SharedLibrary openLibrary(std::span<const std::string> names) {
  SharedLibrary library;
  for (const std::string& name : names) {
    LibraryAttempt& attempt = library.attempts.emplace_back();
    attempt.name = name;
    system::OpenedLibrary opened = system::openLibrary(name);
    library.handle = opened.handle;
    if (library.handle != nullptr) {
      library.path = std::move(opened.file);
      break;
    }
    attempt.words = oneLine(opened.words, kLongestWords);
    attempt.dependency = missingDependency(attempt.words, name);
  }
  return library;
}

const LibraryAttempt* mostInformativeAttempt(const SharedLibrary& library) {
  const LibraryAttempt* telling = nullptr;
  for (const LibraryAttempt& attempt : library.attempts) {
    if (attempt.words.empty()) continue;
    if (telling == nullptr || (wasFound(attempt) && !wasFound(*telling))) telling = &attempt;
  }
  return telling;
}

}  // namespace palpate::device
