// Where a test finds the sources, its data and the programs of its build. Functions and not macros: an absolute path in
// a compiler's arguments would keep ccache from answering in another clone.
#pragma once

#include <filesystem>
#include <string>

namespace palpate::support {

/// Of the repository.
std::filesystem::path sourceFolder();

/// tests/data of the repository.
std::filesystem::path testData();

/// Where `palpate` lies.
std::filesystem::path buildFolder();

/// The built `palpate`, as a shell or exec takes it.
std::string builtProgram();

}  // namespace palpate::support
