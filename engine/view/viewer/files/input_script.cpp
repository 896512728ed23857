#include "view/viewer/files/input_script.h"

#include <fmt/format.h>

#include "palpate/base/csv.h"
#include "palpate/base/error.h"
#include "palpate/base/path_text.h"
#include "palpate/base/text.h"

namespace palpate::viewer {

namespace {

using window::InputEvent;

constexpr std::size_t kMaxScriptBytes = std::size_t{1} << 22;

constexpr NumberRange kScriptTimesS{0.0, 1e5};
constexpr NumberRange kPixels{-1e5, 1e5};
constexpr NumberRange kSides{16.0, 16384.0};
constexpr NumberRange kNotches{-1000.0, 1000.0};
constexpr NumberRange kHeadMm{-1e5, 1e5};

[[noreturn]] void fail(const CsvRow& row, std::string_view cause) { throw Error::atLine(row.file, row.line, cause); }

std::string_view field(const CsvRow& row, std::size_t i, std::string_view what) {
  if (i >= row.fields.size())
    fail(row, fmt::format("'{}' needs {}", row.fields.size() > 1 ? row.fields[1] : "?", what));
  return row.fields[i];
}

window::Modifiers modifiersFrom(const CsvRow& row, std::size_t first) {
  window::Modifiers modifiers;
  for (std::size_t i = first; i < row.fields.size(); ++i) {
    if (row.fields[i] == "ctrl") {
      modifiers.ctrl = true;
    } else if (row.fields[i] == "shift") {
      modifiers.shift = true;
    } else {
      fail(row, fmt::format("'{}' is not a modifier: ctrl or shift", row.fields[i]));
    }
  }
  return modifiers;
}

window::Button buttonFrom(const CsvRow& row) {
  const std::string_view name = field(row, 2, "a button: left, right or middle");
  if (name == "left") return window::Button::left;
  if (name == "right") return window::Button::right;
  if (name == "middle") return window::Button::middle;
  fail(row, fmt::format("'{}' is not a button: left, right or middle", name));
}

/// Any key of the table by its name, and single letters and digits.
window::Chord chordFrom(const CsvRow& row) {
  std::string_view name = field(row, 2, "a key");
  for (const window::KeyBinding& binding : window::keyTable()) {
    for (const window::Chord& chord : {binding.chord, binding.also}) {
      if (chord.key != window::Key::none && window::nameOf(chord) == name) return chord;
    }
  }
  window::Modifiers modifiers;
  for (const auto& [prefix, flag] : {std::pair{"Ctrl+", &modifiers.ctrl}, std::pair{"Shift+", &modifiers.shift}}) {
    if (name.starts_with(prefix)) {
      *flag = true;
      name.remove_prefix(std::string_view(prefix).size());
    }
  }
  for (const window::KeyBinding& binding : window::keyTable()) {
    if (window::nameOf({binding.chord.key, {}}) == name) return {binding.chord.key, modifiers};
  }
  fail(row, fmt::format("unknown key '{}'; the F1 page lists the keys", name));
}

InputEvent makeInputEvent(InputEvent::Kind kind, const Vec2& cursor) { return {.kind = kind, .at = cursor}; }

/// Reads row by row; the cursor stays where the last move put it.
class Reader {
 public:
  explicit Reader(std::string_view file) : folder_(pathOf(file).parent_path()) {}

  void read(const CsvRow& row) {
    const double time = csvNumber(row, 0, "time", kScriptTimesS);
    if (time < last_time_) fail(row, "times must not go back");
    last_time_ = time;
    now_ = time;
    readEvent(row, field(row, 1, "an event"));
  }
  std::vector<ScriptEvent> events;

 private:
  void readEvent(const CsvRow& row, std::string_view name) {
    if (name == "move") {
      cursor_ = Vec2(csvNumber(row, 2, "x", kPixels), csvNumber(row, 3, "y", kPixels));
      add(makeInputEvent(InputEvent::Kind::move, cursor_));
    } else if (name == "down" || name == "up") {
      InputEvent event = makeInputEvent(InputEvent::Kind::button, cursor_);
      event.button = buttonFrom(row);
      event.down = name == "down";
      event.modifiers = modifiersFrom(row, 3);
      add(event);
    } else if (name == "scroll") {
      InputEvent event = makeInputEvent(InputEvent::Kind::scroll, cursor_);
      event.notches = csvNumber(row, 2, "notches", kNotches);
      event.modifiers = modifiersFrom(row, 3);
      add(event);
    } else if (name == "key") {
      addKey(chordFrom(row));
    } else if (name == "text") {
      InputEvent event = makeInputEvent(InputEvent::Kind::text, cursor_);
      event.text = field(row, 2, "a text");
      add(event);
    } else {
      readWindowEvent(row, name);
    }
  }

  void readWindowEvent(const CsvRow& row, std::string_view name) {
    if (name == "focus") {
      InputEvent event = makeInputEvent(InputEvent::Kind::focus, cursor_);
      const std::string_view word = field(row, 2, "lost or gained");
      if (word != "lost" && word != "gained") fail(row, "focus is lost or gained");
      event.down = word == "gained";
      add(event);
    } else if (name == "leave") {
      add(makeInputEvent(InputEvent::Kind::leave, cursor_));
    } else if (name == "drop") {
      InputEvent event = makeInputEvent(InputEvent::Kind::drop, cursor_);
      event.text = (folder_ / pathOf(field(row, 2, "a file"))).string();
      add(event);
    } else if (name == "size") {
      ScriptEvent& event = events.emplace_back();
      event.kind = ScriptEvent::Kind::size;
      event.width = sizeFrom(row, 2);
      event.height = sizeFrom(row, 3);
      event.time_s = now_;
    } else if (name == "head") {
      ScriptEvent& event = events.emplace_back();
      event.kind = ScriptEvent::Kind::head;
      event.head_mm = {csvNumber(row, 2, "x", kHeadMm), csvNumber(row, 3, "y", kHeadMm),
                       csvNumber(row, 4, "z", kHeadMm)};
      event.time_s = now_;
    } else if (name == "close") {
      events.emplace_back().kind = ScriptEvent::Kind::close;
      events.back().time_s = now_;
    } else {
      fail(row, fmt::format("unknown event '{}'", name));
    }
  }

  int sizeFrom(const CsvRow& row, std::size_t column) const {
    return static_cast<int>(csvNumber(row, column, "pixels", kSides));
  }

  void add(InputEvent event) {
    event.time_s = now_;
    events.push_back({ScriptEvent::Kind::input, std::move(event), 0, 0, now_, Vec3::Zero()});
  }

  void addKey(const window::Chord& chord) {
    InputEvent event = makeInputEvent(InputEvent::Kind::key, cursor_);
    event.key = chord.key;
    event.modifiers = chord.modifiers;
    event.down = true;
    add(event);
    event.down = false;
    event.modifiers = {};  // released with it: a Ctrl that stays down keeps fields from accepting the next text
    add(event);
  }

  std::filesystem::path folder_;
  Vec2 cursor_ = Vec2::Zero();
  double last_time_ = 0.0;
  double now_ = 0.0;
};

}  // namespace

std::vector<ScriptEvent> parseInputScript(std::string_view text, std::string_view file) {
  Reader reader(file);
  forEachCsvRow(text, file, [&](const CsvRow& row) { reader.read(row); });
  return std::move(reader.events);
}

std::vector<ScriptEvent> readInputScript(const std::filesystem::path& file) {
  return parseInputScript(readFile(file, kMaxScriptBytes), file.string());
}

}  // namespace palpate::viewer
