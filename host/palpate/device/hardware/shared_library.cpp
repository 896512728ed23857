// dlopen with RTLD_GLOBAL: drivers load parts of their own that look for the names of the first. Cold path.
#include "palpate/device/hardware/shared_library.h"

#include <dlfcn.h>
#include <link.h>

#include <cstdlib>
#include <filesystem>

#include "palpate/base/nearest_name.h"

namespace palpate::device {

namespace {

constexpr std::string_view kNotOpened = ": cannot open shared object file";
constexpr std::size_t kLongestWords = 400;

std::string loaderWords() {
  const char* words = ::dlerror();
  return words == nullptr ? "no reason given" : oneLine(words, kLongestWords);
}

/// Where the loader found it.
std::string pathOf(void* handle, const std::string& name) {
  const link_map* map = nullptr;
  if (::dlinfo(handle, RTLD_DI_LINKMAP, static_cast<void*>(&map)) != 0 || map == nullptr) return name;
  return map->l_name;
}

bool wasFound(const LibraryAttempt& attempt) {
  return !attempt.dependency.empty() || attempt.words.find(kNotOpened) == std::string::npos ||
         attempt.words.find("No such file") == std::string::npos;
}

}  // namespace

void* SharedLibrary::symbol(const char* name) const { return handle == nullptr ? nullptr : ::dlsym(handle, name); }

std::string missingDependency(std::string_view words, std::string_view wanted) {
  const std::size_t end = words.find(kNotOpened);
  if (end == std::string_view::npos) return {};
  const std::string_view named = words.substr(0, end);
  const auto file_of = [](std::string_view path) { return std::filesystem::path(path).filename(); };
  return file_of(named) == file_of(wanted) ? std::string() : std::string(named);
}

std::vector<std::string> namesToTry(const std::string& file, const char* variable, std::vector<std::string> usual) {
  if (!file.empty()) return {file};
  const char* said = std::getenv(variable);  // NOLINT(concurrency-mt-unsafe)
  if (said != nullptr && *said != '\0') return {said};
  return usual;
}

SharedLibrary openLibrary(std::span<const std::string> names) {
  SharedLibrary library;
  for (const std::string& name : names) {
    LibraryAttempt& attempt = library.attempts.emplace_back();
    attempt.name = name;
    library.handle = ::dlopen(name.c_str(), RTLD_LAZY | RTLD_GLOBAL);
    if (library.handle != nullptr) {
      library.path = pathOf(library.handle, name);
      break;
    }
    attempt.words = loaderWords();
    attempt.dependency = missingDependency(attempt.words, name);
  }
  return library;
}

const LibraryAttempt* tellingAttempt(const SharedLibrary& library) {
  const LibraryAttempt* telling = nullptr;
  for (const LibraryAttempt& attempt : library.attempts) {
    if (attempt.words.empty()) continue;
    if (telling == nullptr || (wasFound(attempt) && !wasFound(*telling))) telling = &attempt;
  }
  return telling;
}

}  // namespace palpate::device
