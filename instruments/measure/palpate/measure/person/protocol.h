// A person's measuring plan: protocol.toml of their folder.
//
//   protocol.toml ─ readProtocol ─► Protocol ─ plannedPresses ─► which pictures are wanted (person_folder.h)
//
// A person is a code. Names, ages and faces are never requested.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/measure/measurement.h"

namespace palpate::measure {

struct ProtocolPoint {
  std::string name;
  std::string at = {};  ///< in words, for people
  Vec2 place_mm = Vec2::Zero();
};

struct ProtocolDrag {
  std::string word;  ///< "up": as pictures are named
  double degrees = 90.0;
};

/// Pictures of a press that are not named by the pattern, or whose contact was marked.
struct ListedPictures {
  std::string press;
  std::string before = {};
  std::string before2 = {};
  std::string after = {};
  std::string released = {};
  std::optional<Vec2> contact_px = {};
};

struct Protocol {
  std::string person;
  double spacing_mm = 30.0;
  double drift_mm = 0.4;
  HeadTowards head = HeadTowards::top;
  bool partial = false;
  int presses = 3;  ///< per drag and point
  int enough = 2;   ///< accepted ones needed
  std::vector<ProtocolDrag> drags;
  std::vector<ProtocolPoint> points;
  std::vector<ListedPictures> pictures = {};
  // The body in the scene; 0: the built-in one's.
  double stature_mm = 0.0;
  double body_mass_index = 0.0;
};

/// Returns the fault of a person's code; empty: none. Letters and digits, one digit at least, so that it is not a name.
std::string faultOfPerson(std::string_view code);

/// Throws Error with the line for an unreadable file, an unknown key, a value out of range, or a repeated name.
Protocol readProtocol(const std::filesystem::path& file);
Protocol parseProtocol(std::string_view text, std::string_view file);

/// Text of a file with its explanations.
std::string protocolText(const Protocol& protocol);

struct PlannedPress {
  std::string name;  ///< "P1_up_1"
  std::string point;
  Vec2 place_mm = Vec2::Zero();
  double drag_deg = 90.0;
};

/// Point by point, drag by drag.
std::vector<PlannedPress> plannedPresses(const Protocol& protocol);

}  // namespace palpate::measure
