// The tables [[finger]] and [[device]] of a scene file: who touches the body, the steps of a finger's script, and what
// holds a finger.
#include <algorithm>
#include <cctype>

#include "palpate/contact/pressure_field.h"
#include "palpate/scene/detail/scene_keys.h"
#include "palpate/scene/words.h"

namespace palpate::scene {

namespace {

constexpr std::size_t kMaxButtons = 32;  // bits of a word

/// The keys that a step of one kind takes; what belongs to another kind is an unknown key.
std::vector<Key<Step>> stepKeys(Move move) {
  using S = Step;
  std::vector<Key<S>> keys = {
      choice<S, Move>("do", &S::move, "Movement of the finger."),
      number<S>("seconds", &S::seconds, above(0, 3600), "Duration of the movement."),
  };
  const Range length = between(-kLongestMm, kLongestMm);
  if (move == Move::press)
    keys.push_back(number<S>("depth_mm", &S::depth_mm, length, "Depth in the skin to press to."));
  if (move == Move::lift)
    keys.push_back(number<S>("height_mm", &S::height_mm, length, "Height above the skin to lift to."));
  if (move == Move::drag) keys.push_back(point2<S>("by_mm", &S::by_mm, length, "Distance to drag along x and y."));
  if (move == Move::circle) {
    keys.push_back(
        number<S>("radius_mm", &S::radius_mm, above(0, kLongestMm), "Radius of the circle around the current place."));
    keys.push_back(number<S>("turns", &S::turns, between(-1000, 1000),
                             "Number of turns, counter-clockwise; negative is clockwise."));
  }
  return keys;
}

Move readMove(const TomlNode& table, const Entry& entry) {
  const TomlNode* word = table.get("do");
  if (word == nullptr) entry.fail(fmt::format("needs do = {}", formatChoices(wordList<Move>())));
  return readChoice<Move>({*word, entry.file, entry.name + " do"});
}

Step readStep(const Entry& entry) {
  const TomlNode& table = tableOf(entry);
  Step step;
  const Move move = readMove(table, entry);
  const std::string title = fmt::format("{} {}", entry.name, wordFor(move));
  readTable(table, title, entry.file, stepKeys(move), step);
  return step;
}

std::string showStep(const Step& step) {
  std::string words;
  for (const Key<Step>& key : stepKeys(step.move)) {
    words += fmt::format("{}{} = {}", words.empty() ? "" : ", ", key.name, key.show(step));
  }
  return "{ " + words + " }";
}

std::string showScript(const Finger& finger) {
  std::string lines;
  for (const Step& step : finger.steps) lines += "  " + showStep(step) + ",\n";
  return lines.empty() ? lines : "[\n" + lines + "]";
}

Key<Finger> scriptKey() {
  const auto read = [](Finger& finger, const Entry& entry) {
    const TomlList* list = entry.node.list();
    if (list == nullptr) entry.fail("must be a list of steps");
    for (const TomlNode& node : *list) finger.steps.push_back(readStep({node, entry.file, entry.name}));
  };
  return {"script", "list of steps",
          "Movements of the finger, step by step; see below. Default: with a place a press and a lift, without one a "
          "path that suits the body.",
          read, showScript};
}

Key<Finger> padKey() {
  constexpr Range kTaxels = between(contact::kMinTaxels, contact::kMaxTaxels);
  const auto read = [=](Finger& finger, const Entry& entry) {
    finger.pad = readCount(entry, 0, contact::kMaxTaxels);
    if (finger.pad != 0 && finger.pad < contact::kMinTaxels) {
      entry.fail("= " + outOfRange(fmt::format("{}", finger.pad), kTaxels) + ", or 0");
    }
  };
  return {
      "pad",
      "whole number" + rangeSuffix(kTaxels) + ", or 0",
      "Pad: taxels along a side of the finger's pressure sensor, at least 2; 0 is none (docs/explanation/lumps.md).",
      read,
      [](const Finger& finger) { return fmt::format("{}", finger.pad); },
      {KeyForm::Kind::whole, 0.0, static_cast<double>(contact::kMaxTaxels)}};
}

std::vector<Key<Finger>> fingerKeys() {
  using S = Finger;
  return {
      text<S>("name", &S::name, "Letters, digits, '-' and '_'; unique (default: index, middle, ring, ...)."),
      number<S>("radius_mm", &S::radius_mm, between(0, 1000), "0 is a point, 8 a fingertip."),
      file<S>("trajectory", &S::trajectory, "Table t_s,x_mm,y_mm,z_mm, in place of a script."),
      text<S>("at", &S::at,
              "Script: the place it starts over, by name: \"T6\", \"left PSIS\", \"T6 right 30 mm\" "
              "(docs/reference/names.md)."),
      unlessNamed(point2<S>("at_mm", &S::at_mm, between(-kLongestMm, kLongestMm),
                            "Script: the same place in coordinates, seen along z.")),
      number<S>("start_height_mm", &S::start_height_mm, between(-kLongestMm, kLongestMm),
                "Script: height above the skin at the start."),
      scriptKey(),
      padKey(),
      number<S>("pad_mm", &S::pad_mm, between(1, 100), "Pad: edge length of its square of taxels."),
  };
}

bool isPlainName(const std::string& name) {
  const auto plain = [](unsigned char c) { return (c < 0x80 && std::isalnum(c) != 0) || c == '-' || c == '_'; };
  return !name.empty() && std::all_of(name.begin(), name.end(), plain);
}

void checkFinger(const Finger& finger, const Entry& entry) {
  if (!finger.name.empty() && !isPlainName(finger.name))
    entry.fail("name may contain only letters, digits, '-' and '_'");
  if (!finger.trajectory.empty() && !finger.steps.empty()) entry.fail("takes a trajectory or a script, not both");
}

/// Presses at a named place by default. Without a place the finger finds its own way.
void pressNamedPlace(const TomlNode& table, Finger& finger) {
  const bool has_place = table.get("at") != nullptr || table.get("at_mm") != nullptr;
  if (!has_place || !finger.hasAutomaticPath()) return;
  finger.steps = {{.move = Move::press}, {.move = Move::lift}};
}

std::vector<Key<DeviceSettings>> deviceKeys() {
  using S = DeviceSettings;
  const auto button = [](const char* name, std::size_t S::*member, const char* meaning) {
    return count<S>(name, member, 0, kMaxButtons, meaning);
  };
  return {
      text<S>("name", &S::name,
              "Name as for `--device`, followed by :WHICH where there are several (docs/reference/devices.md); for "
              "plugins only the plugin's name, never a path."),
      choice<S, HeldFinger>("finger", &S::finger, "Finger that the device moves: the scene's first or second."),
      number<S>("scale", &S::scale, between(0.05, 20), "Millimetres of the body per millimetre of the device."),
      point3<S>("turn_deg", &S::turn_deg, between(-360, 360),
                "Orientation of the device: rotation about the body's x, then y, then z."),
      place<S>("origin_mm", &S::origin_mm, between(-kLongestMm, kLongestMm),
               "Place in the body of the device's own origin (default: near the back, by the body)."),
      button(
          "clutch_button", &S::clutch_button,
          "Clutch: while held, the device moves and the finger stays, without force; 1 is the first button, 0 none."),
      button("stop_button", &S::stop_button, "Button that triggers the emergency stop; 1 is the first, 0 none."),
  };
}

std::vector<KeyRow> describeFinger() {
  std::vector<KeyRow> rows = describe<Finger>("[[finger]]", fingerKeys());
  for (const auto& [word, move] : WordsOf<Move>::kAll) {
    const std::string title = fmt::format("script, do = \"{}\"", word);
    for (KeyRow& row : describe<Step>(title, stepKeys(move))) {
      if (row.key != "do") rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace

Section fingerSection() {
  const auto read = [](const TomlNode& table, const Entry& entry) {
    Finger finger;
    finger.scene_file = entry.file;
    finger.line = entry.line();
    readTable(table, entry.name, entry.file, fingerKeys(), finger);
    checkFinger(finger, entry);
    pressNamedPlace(table, finger);
    return finger;
  };
  return listSection<Finger>("finger", "Any number of fingers that touch the body, independent of each other.",
                             &Scene::fingers, read, fingerKeys(), describeFinger);
}

Section deviceSection() {
  const auto read = [](const TomlNode& table, const Entry& entry) {
    DeviceSettings device;
    readTable(table, entry.name, entry.file, deviceKeys(), device);
    if (device.name.empty()) entry.fail("needs a name");
    return device;
  };
  return listSection<DeviceSettings>(
      "device", "A device that moves a finger, and the placement of its workspace in the body.", &Scene::devices, read,
      deviceKeys(), [] { return describe<DeviceSettings>("[[device]]", deviceKeys()); });
}

}  // namespace palpate::scene
