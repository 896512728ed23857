// dlopen with RTLD_GLOBAL: drivers load parts of their own that look for the names of the first.
#include <dlfcn.h>
#ifndef __APPLE__
#include <link.h>
#endif

#include "palpate/base/system/library.h"

namespace palpate::system {

namespace {

/// Where the loader found it.
std::string libraryFile([[maybe_unused]] void* handle, const std::string& name) {
#ifndef __APPLE__
  const link_map* map = nullptr;
  if (::dlinfo(handle, RTLD_DI_LINKMAP, static_cast<void*>(&map)) == 0 && map != nullptr) return map->l_name;
#endif
  return name;
}

}  // namespace

OpenedLibrary openLibrary(const std::string& name) {
  OpenedLibrary library;
  library.handle = ::dlopen(name.c_str(), RTLD_LAZY | RTLD_GLOBAL);
  if (library.handle != nullptr) {
    library.file = libraryFile(library.handle, name);
  } else {
    const char* words = ::dlerror();
    library.words = words == nullptr ? "no reason given" : words;
  }
  return library;
}

void* findSymbol(void* library, const char* name) { return ::dlsym(library, name); }

const char* libraryExtension() {
#ifdef __APPLE__
  return ".dylib";
#else
  return ".so";
#endif
}

}  // namespace palpate::system
