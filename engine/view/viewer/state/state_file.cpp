#include "view/viewer/state/state_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "palpate/base/error.h"
#include "palpate/base/language.h"
#include "palpate/base/output_file.h"
#include "palpate/base/path_text.h"
#include "palpate/base/system/process.h"
#include "palpate/base/text.h"
#include "palpate/base/words.h"
#include "palpate/scene/detail/key_table.h"
#include "palpate/scene/detail/toml_table.h"

namespace palpate::viewer {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxStateBytes = std::size_t{1} << 18;

/// Each remembered value with its name, once for reading and writing: `visit(name, value)`.
template <class Visitor>
void forEachValue(Remembered& r, const Visitor& visit) {
  ViewState& s = r.state;
  visit("window_x", r.window.x);
  visit("window_y", r.window.y);
  visit("window_width", r.window.width);
  visit("window_height", r.window.height);
  visit("full_screen", r.window.full_screen);
  visit("panel", s.shown.panel);
  visit("panel_right", s.shown.panel_right);
  visit("plots", s.shown.plots);
  visit("numbers", s.shown.numbers);
  visit("reach", s.shown.reach);
  visit("theme", s.theme);
  visit("text_size", s.text_size);
  visit("reduced_motion", s.reduced_motion);
  visit("language", s.language);
  visit("hints", s.hints);
  visit("start_page", s.start_page);
  visit("keeps_last_hour", s.keeps_last_hour);
  visit("shading", s.look.shading);
  visit("adapts_resolution", s.adapts_resolution);
  visit("simpler_when_slow", s.simpler_when_slow);
  visit("drawn_finger", s.look.finger);  // finger_shape counted other forms
  visit("white_background", s.look.white_background);
  visit("lens", s.look.lens);
  visit("press_by", s.touch.by);
  visit("depth_mm", s.touch.depth_mm);
  visit("force_n", s.touch.force_n);
  visit("resisting_cursor", s.touch.resisting_cursor);
  visit("mouse_preset", s.input.preset);
  visit("swap_left_and_right", s.input.swap_left_and_right);
  visit("invert_zoom", s.input.invert_zoom);
  visit("turn_speed", s.input.speed);
  visit("stereo_mode", s.stereo.mode);
  visit("eye_distance_mm", s.stereo.eye_distance_mm);
  visit("swap_eyes", s.stereo.swap_eyes);
  visit("head", s.head.on);
  visit("head_x_mm", s.head.expected_mm.x());
  visit("head_y_mm", s.head.expected_mm.y());
  visit("head_z_mm", s.head.expected_mm.z());
  visit("head_offset_x_mm", s.head.offset_mm.x());
  visit("head_offset_y_mm", s.head.offset_mm.y());
  visit("head_offset_z_mm", s.head.offset_mm.z());
  visit("screen_height_mm", s.head.screen_height_mm);
}

/// Number of enumerators of an enumeration that a file may name by number.
template <class E>
constexpr int enumeratorCount(E) {
  return static_cast<int>(WordsOf<E>::kAll.size());
}
constexpr int enumeratorCount(window::Theme) { return static_cast<int>(window::kThemeNames.size()); }
constexpr int enumeratorCount(window::MousePreset) { return static_cast<int>(window::kMousePresetNames.size()); }

/// Windows and heads are never farther away.
constexpr std::int64_t kMaxPixels = 100'000;
constexpr double kMaxMm = 1e5;

/// A value out of range or of another type counts as missing: the default stays.
struct StateReader {
  const scene::TomlNode& table;
  void operator()(const char* name, bool& value) const {
    if (const scene::TomlNode* node = table.get(name)) value = node->flag().value_or(value);
  }
  void operator()(const char* name, double& value) const {
    const scene::TomlNode* node = table.get(name);
    const double read = node == nullptr ? value : node->number().value_or(value);
    if (std::abs(read) <= kMaxMm) value = read;
  }
  void operator()(const char* name, int& value) const {
    const std::int64_t read = whole(name, value);
    if (std::abs(read) <= kMaxPixels) value = static_cast<int>(read);
  }
  void operator()(const char* name, std::string& value) const {
    if (const scene::TomlNode* node = table.get(name)) value = node->text().value_or(value);
  }
  template <class E>
  requires std::is_enum_v<E>
  void operator()(const char* name, E& value) const {
    const std::int64_t read = whole(name, static_cast<int>(value));
    if (read >= 0 && read < enumeratorCount(value)) value = static_cast<E>(read);
  }
  std::int64_t whole(const char* name, std::int64_t standard) const {
    const scene::TomlNode* node = table.get(name);
    return node == nullptr ? standard : node->whole().value_or(standard);
  }
};

struct Writer {
  std::string& text;
  void operator()(const char* name, bool value) const { text += fmt::format("{} = {}\n", name, value); }
  void operator()(const char* name, int value) const { text += fmt::format("{} = {}\n", name, value); }
  void operator()(const char* name, double value) const { text += fmt::format("{} = {}\n", name, value); }
  void operator()(const char* name, const std::string& value) const {
    text += fmt::format("{} = {}\n", name, scene::inQuotes(value));
  }
  template <class E>
  requires std::is_enum_v<E>
  void operator()(const char* name, E value) const { text += fmt::format("{} = {}\n", name, static_cast<int>(value)); }
};

/// Repairs values of a hand-edited file.
void repairValues(Remembered& r) {
  r.window.width = std::clamp(r.window.width, 320, 16384);
  r.window.height = std::clamp(r.window.height, 240, 16384);
  if (std::ranges::find(languages(), r.state.language, &Language::code) == languages().end()) r.state.language.clear();
  r.state.text_size = std::clamp(r.state.text_size, 0.75, 2.5);
  r.state.touch.depth_mm = std::clamp(r.state.touch.depth_mm, 0.0, kMaxDepthMm);
  r.state.touch.force_n = std::clamp(r.state.touch.force_n, 0.0, kMaxForceN);
  r.state.input.speed = std::clamp(r.state.input.speed, 0.25, 4.0);
  r.state.stereo.eye_distance_mm = std::clamp(r.state.stereo.eye_distance_mm, 0.0, 80.0);
  HeadSettings& head = r.state.head;
  head.expected_mm.z() = std::max(head.expected_mm.z(), kNearestHeadMm);
  head.screen_height_mm = std::clamp(head.screen_height_mm, kMinScreenMm, kMaxScreenMm);
}

}  // namespace

fs::path stateFile() {
  const fs::path settings = system::settingsFolder();
  return settings.empty() ? fs::path() : settings / "palpate" / "window.toml";
}

std::string stateAsToml(const Remembered& remembered) {
  std::string text = fmt::format("version = {}\n", kStateVersion);
  Remembered copy = remembered;
  forEachValue(copy, Writer{text});
  std::vector<std::string> recent;
  for (const std::string& file : remembered.state.recent) recent.push_back(scene::inQuotes(file));
  text += fmt::format("recent = [{}]\n", fmt::join(recent, ", "));
  return text;
}

Remembered parseState(std::string_view text, std::string_view name) {
  const scene::TomlNode table = scene::parseToml(text, name);
  const StateReader reader{table};
  if (reader.whole("version", 0) != kStateVersion) throw Error::inFile(name, "was written by another version");
  Remembered remembered;
  forEachValue(remembered, reader);
  if (const scene::TomlNode* recent = table.get("recent"); recent != nullptr && recent->list() != nullptr) {
    for (const scene::TomlNode& node : *recent->list()) {
      if (const auto file = node.text()) remembered.state.recent.push_back(*file);
    }
  }
  if (remembered.state.recent.size() > kRecentFiles) remembered.state.recent.resize(kRecentFiles);
  repairValues(remembered);
  return remembered;
}

StateReading readState(const fs::path& file) {
  StateReading reading;
  std::error_code error;
  if (file.empty() || !fs::exists(file, error)) return reading;
  try {
    reading.remembered = parseState(readFile(file, kMaxStateBytes), file.string());
  } catch (const std::exception& failure) {
    fs::rename(file, withEnding(file, ".bad"), error);
    reading.note = fmt::format("{}; it was put aside and the defaults are used", failure.what());
  }
  return reading;
}

bool writeState(const fs::path& file, const Remembered& remembered) {
  if (file.empty()) return false;
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  try {
    OutputFile out(file);
    out.write(stateAsToml(remembered));
    out.commit();
  } catch (const Error&) {
    return false;
  }
  return true;
}

void remember(std::vector<std::string>& recent, const std::string& file) {
  const std::string full = fs::absolute(pathOf(file)).lexically_normal().string();
  std::erase(recent, full);
  recent.insert(recent.begin(), full);
  if (recent.size() > kRecentFiles) recent.resize(kRecentFiles);
}

}  // namespace palpate::viewer
