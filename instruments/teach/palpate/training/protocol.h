// Settings of training and tests: the sites, the hidden dysfunction, and a block's settings for each kind of session.
// From a TOML file or built in (`protocolNamed`).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/words.h"
#include "palpate/lumps/lump_task.h"
#include "palpate/training/block.h"
#include "palpate/training/exploration.h"

namespace palpate::training {

enum class SessionKind : std::uint8_t {
  practice,
  mastery,
  pre_test,
  post_test,
  exam,
  retention,
  free,
  lump,
  lump_exam
};

/// Lumps are hidden, not stiffer places: session/lump_session.h.
constexpr bool hidesLumps(SessionKind kind) { return kind == SessionKind::lump || kind == SessionKind::lump_exam; }

/// The hidden dysfunction apart from its change.
struct HiddenPlace {
  double radius_mm = 22.0;
  double edge_softness = 0.4;
  /// Depth under the skin. At the skin it is weaker by 1 / (1 + (depth / radius)^2), and wider.
  double depth_mm = 0.0;
  /// The bone under it is this much nearer to the skin: stiffer by the depth law, besides the change. 0: unchanged.
  double bony_displacement_mm = 0.0;
  friend bool operator==(const HiddenPlace&, const HiddenPlace&) = default;
};

struct SessionSettings {
  BlockSettings block;
  bool feedback = false;           ///< right or wrong after each answer, and the true site may be felt
  double limit_s = 45.0;           ///< for a trial; 0: none
  bool all_sites = true;           ///< every site must be felt before an answer counts as explored; else flagged
  bool natural_stiffness = false;  ///< the body's own stiffness map; else the same everywhere, as for measurement
};

struct Protocol {
  std::string id = "vhb";
  int version = 1;
  std::string title;
  std::vector<std::string> sites;  ///< place names; empty: the twelve
  double base_n_per_mm = 0.3;      ///< for the uniform tissue of tests
  HiddenPlace hidden;
  ExplorationSettings exploration;
  double break_after_min = 15.0;  ///< a break is offered after this long; 0: never
  double least_days_to_retention = 7.0;
  SessionSettings practice, mastery, pre_test, post_test, exam, retention;
  std::optional<lumps::LumpTask> lump = {};  ///< for sessions with lumps; nothing without them
};

/// free, and sessions with lumps: that of practice.
const SessionSettings& settingsOf(const Protocol& protocol, SessionKind kind);

/// The largest change that a block of these settings may hide.
double largestChange(const BlockSettings& settings);

/// The documented protocol: practice 2-down-1-up from 50 %, blocks of 20; tests marginal psi, 40 trials; examination
/// sequential at 20 %.
Protocol builtInProtocol();
/// The built-in protocol with sessions that hide lumps.
Protocol builtInLumpProtocol();
/// "vhb", "lumps" or a file. Throws Error with the line for an unreadable file, an unknown key, a value out of range.
Protocol protocolNamed(const std::string& name_or_file);
Protocol parseProtocol(std::string_view text, std::string_view file);
/// With explanations; parseProtocol gives the same settings back.
std::string protocolText(const Protocol& protocol);
/// Hash of protocolText (SHA-256, hex).
std::string protocolSha256(const Protocol& protocol);

}  // namespace palpate::training

template <>
struct palpate::WordsOf<palpate::training::SessionKind> {
  using V = palpate::training::SessionKind;
  static constexpr std::array kAll = {
      Word{"practice", V::practice},   Word{"mastery", V::mastery}, Word{"pre_test", V::pre_test},
      Word{"post_test", V::post_test}, Word{"exam", V::exam},       Word{"retention", V::retention},
      Word{"free", V::free},           Word{"lump", V::lump},       Word{"lump_exam", V::lump_exam}};
};
