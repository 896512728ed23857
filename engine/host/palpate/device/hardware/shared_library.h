// A vendor's library looked for at run time: which names were tried, the loader's answers, and missing functions.
//
// Nothing of a vendor is needed to build. A library that was opened stays open until the program ends: drivers leave
// threads behind that still run in it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace palpate::device {

/// One name that was tried.
struct LibraryAttempt {
  std::string name;
  std::string words;       ///< the loader's own; empty when it opened
  std::string dependency;  ///< the library that this one needs and that is missing, if the loader said so
};

struct SharedLibrary {
  void* handle = nullptr;
  std::string path;  ///< path of the opened file
  std::vector<LibraryAttempt> attempts;

  explicit operator bool() const { return handle != nullptr; }
  /// Null when it has none of that name.
  void* symbol(const char* name) const;
};

/// The names to try: only `file` where it is not empty, else only what the environment's `variable` says, else the
/// usual ones.
std::vector<std::string> namesToTry(const std::string& file, const char* variable, std::vector<std::string> usual);

/// Tries the names in their order and keeps the first that opens.
SharedLibrary openLibrary(std::span<const std::string> names);

/// The dependency that words of the loader name, or nothing: "libB.so: cannot open shared object file" while `wanted`
/// was being opened.
std::string missingDependency(std::string_view words, std::string_view wanted);

/// The most informative attempt: one whose file is there but does not load goes before those that were not found.
const LibraryAttempt* mostInformativeAttempt(const SharedLibrary& library);

/// A pointer to a function of a library, null where it has none.
template <class Function>
void resolve(const SharedLibrary& library, const char* name, Function*& function) {
  function = reinterpret_cast<Function*>(library.symbol(name));
}

/// The same for a function that nothing works without; `missing` gets the name of one that is not there.
template <class Function>
void resolveNeeded(const SharedLibrary& library, const char* name, Function*& function,
                   std::vector<std::string>& missing) {
  resolve(library, name, function);
  if (function == nullptr) missing.emplace_back(name);
}

}  // namespace palpate::device
