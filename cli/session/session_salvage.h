// What `palpate body repair` does with a session: salvages it and says what was lost.
#pragma once

#include <filesystem>

namespace palpate::app {

/// A session by its first bytes, or, where those are lost, by its name: "run.session", "run.session.2.partial".
bool isOrWasSession(const std::filesystem::path& file);

void salvageSession(const std::filesystem::path& file, const std::filesystem::path& out, bool json);

}  // namespace palpate::app
