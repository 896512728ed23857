#include "palpate/training/protocol.h"

namespace palpate::training {

namespace {

/// The Virtual Haptic Back's own levels, rising.
std::vector<double> vhbLevels() { return {kVhbLevels.rbegin(), kVhbLevels.rend()}; }

/// Marginal psi, no feedback: three to warm up, 40 that count, four of them plain enough to reveal lapses.
SessionSettings measuringSession() {
  SessionSettings settings;
  settings.block.warm_up = 3;
  settings.block.easy = 4;
  settings.block.stop = {.least = 40, .most = 40};
  return settings;
}

/// Ends as soon as it is sure of either side of the mark.
SessionSettings examSession() {
  SessionSettings settings = measuringSession();
  constexpr double kMark = 0.20;  // until a school's own judges set one
  settings.block.easy = 0;
  settings.block.stop = {.least = 10, .most = 60, .half_width = 0.0, .mark = kMark, .sure = 0.95};
  return settings;
}

SessionSettings practiceSession() {
  SessionSettings settings;
  settings.block = {.method = Method::two_down_one_up,
                    .levels = vhbLevels(),
                    .start = 0.5,
                    .draw = SiteDraw::balanced,
                    .easy_share = 0.1,
                    .stop = {.least = 20, .most = 20}};
  settings.feedback = true;
  settings.limit_s = 0.0;
  settings.all_sites = false;
  return settings;
}

SessionSettings masterySession() {
  SessionSettings settings = practiceSession();
  settings.block.method = Method::mastery;
  settings.block.easy_share = 0.0;
  settings.block.stop = {.least = 40, .most = 40};
  return settings;
}

}  // namespace

const SessionSettings& settingsOf(const Protocol& protocol, SessionKind kind) {
  switch (kind) {
    case SessionKind::mastery:
      return protocol.mastery;
    case SessionKind::pre_test:
      return protocol.pre_test;
    case SessionKind::post_test:
      return protocol.post_test;
    case SessionKind::exam:
      return protocol.exam;
    case SessionKind::retention:
      return protocol.retention;
    case SessionKind::practice:
    case SessionKind::free:
    case SessionKind::lump:
    case SessionKind::lump_exam:
      break;
  }
  return protocol.practice;
}

double largestChange(const BlockSettings& settings) {
  return settings.levels.empty() ? adaptiveLevels(settings.meaning).back() : settings.levels.back();
}

Protocol builtInProtocol() {
  Protocol protocol;
  protocol.title = "Virtual Haptic Back: twelve sites, six levels on both sides";
  protocol.practice = practiceSession();
  protocol.mastery = masterySession();
  protocol.pre_test = protocol.post_test = protocol.retention = measuringSession();
  protocol.exam = examSession();
  return protocol;
}

Protocol builtInLumpProtocol() {
  Protocol protocol = builtInProtocol();
  protocol.id = "lumps";
  protocol.title = "Lumps under the skin: is there one, where, and of which kind";
  protocol.lump = lumps::LumpTask();
  return protocol;
}

}  // namespace palpate::training
