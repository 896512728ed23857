// Distinguishes names of classes and of their records from names of files.
#pragma once

#include <string_view>

namespace palpate::training {

/// A word allowed in a topic and in a certificate: lower-case letters, digits and hyphens, at most 32.
bool isClassWord(std::string_view text);

/// "postgresql://...", or words as libpq has them: "host=/run/postgresql dbname=class". Anything else is a file.
bool isDatabaseAddress(std::string_view text);

}  // namespace palpate::training
