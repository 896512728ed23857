// A library that is opened while the program runs; see device/hardware/shared_library.h for its use. Thread: as the
// system's loader, any.
#pragma once

#include <filesystem>
#include <string>

namespace palpate::system {

struct OpenedLibrary {
  void* handle = nullptr;
  std::string file;   ///< opened file, as far as the system says
  std::string words;  ///< the loader's reason why not; "NAME: cannot open shared object file: No such file
                      ///< or directory" for an unknown name
};

/// Names in it are there for libraries that are opened after it.
OpenedLibrary openLibrary(const std::string& name);

/// Null when it has none of that name.
void* findSymbol(void* library, const char* name);

/// ".so", ".dll"
const char* libraryExtension();

}  // namespace palpate::system
