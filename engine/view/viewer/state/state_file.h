// State that the viewer keeps from one run to the next: the window's place, open panels, recent files, habits.
//
// One TOML file, $XDG_CONFIG_HOME/palpate/window.toml, with a version, written complete or not at all. An unreadable
// one is put aside and never keeps the viewer from starting.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "palpate/window/window.h"
#include "view/viewer/state/view_state.h"

namespace palpate::viewer {

struct Remembered {
  ViewState state;
  window::WindowSettings window;
};

/// Its file, by XDG_CONFIG_HOME or HOME; empty without both.
std::filesystem::path stateFile();

struct StateReading {
  std::optional<Remembered> remembered;  ///< empty on the first run
  std::string note;                      ///< for the user: a file that was put aside
};
/// Never throws.
StateReading readState(const std::filesystem::path& file);

/// Returns false, with no harm done, when it cannot be written.
bool writeState(const std::filesystem::path& file, const Remembered& remembered);

/// As text; parseState throws Error.
std::string stateAsToml(const Remembered& remembered);
Remembered parseState(std::string_view text, std::string_view name);

inline constexpr int kStateVersion = 1;
inline constexpr std::size_t kRecentFiles = 8;
/// Puts a file at the front of the recent ones.
void remember(std::vector<std::string>& recent, const std::string& file);

}  // namespace palpate::viewer
