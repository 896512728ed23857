#include "support/places.h"

namespace palpate::support {

std::filesystem::path sourceFolder() { return PALPATE_SOURCE_DIR; }

std::filesystem::path testData() { return sourceFolder() / "tests/data"; }

std::filesystem::path buildFolder() { return PALPATE_BINARY_DIR; }

std::string builtProgram() { return (buildFolder() / "palpate").string(); }

}  // namespace palpate::support
