// LoadLibrary, without the window that the system would open about a broken one. A full path also adds the library's
// folder to the places where its own dependencies are looked for.
#include <windows.h>

#include <system_error>

#include "palpate/base/path_text.h"
#include "palpate/base/system/library.h"

namespace palpate::system {

namespace {

std::string libraryFile(HMODULE library, const std::string& name) {
  wchar_t file[MAX_PATH * 4];
  const DWORD length = ::GetModuleFileNameW(library, file, MAX_PATH * 4);
  return length == 0 ? name : std::filesystem::path(std::wstring(file, length)).string();
}

std::string wordsOf(const std::string& name, DWORD reason) {
  std::error_code ignored;
  const bool is_there = std::filesystem::exists(pathOf(name), ignored);
  // Worded as by loaders elsewhere. Windows does not name the one that is missing.
  if (reason == ERROR_MOD_NOT_FOUND && !is_there)
    return name + ": cannot open shared object file: No such file or directory";
  if (reason == ERROR_MOD_NOT_FOUND) return name + ": a library that it needs is missing";
  return name + ": " + std::system_category().message(static_cast<int>(reason));
}

}  // namespace

OpenedLibrary openLibrary(const std::string& name) {
  OpenedLibrary library;
  const std::filesystem::path file = pathOf(name);
  DWORD before = 0;
  ::SetThreadErrorMode(SEM_FAILCRITICALERRORS, &before);
  HMODULE handle = ::LoadLibraryExW(file.c_str(), nullptr, file.is_absolute() ? LOAD_WITH_ALTERED_SEARCH_PATH : 0);
  const DWORD reason = ::GetLastError();
  ::SetThreadErrorMode(before, nullptr);
  library.handle = handle;
  (handle != nullptr ? library.file : library.words) =
      handle != nullptr ? libraryFile(handle, name) : wordsOf(name, reason);
  return library;
}

void* findSymbol(void* library, const char* name) {
  return reinterpret_cast<void*>(::GetProcAddress(static_cast<HMODULE>(library), name));
}

const char* libraryExtension() { return ".dll"; }

}  // namespace palpate::system
