// Messages of a class: topics and payloads, written and read. Input is not trusted: anything that is not exactly a
// message of this kind is refused.
//
//   palpate/v1/<class>/st/<station>/
//     status   retained, last will "offline"     state    retained, cleared at sign-off     live   10 Hz, QoS 0
//     session, block, trial, event, ...: rows of the outbox, QoS 1 (training/records/row_json.h)
//     ack      collector -> station: what is in the database         cmd   instructor -> station
//     check    asks the collector whether its database answers; acknowledged as a row is
//
// Each message has the station's sequence number, a UUID and the station's monotonic time. Live messages have at most
// 200 bytes, the others 4 kB; a row that is longer travels compressed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/base/vec.h"
#include "palpate/base/words.h"
#include "palpate/training/protocol.h"
#include "palpate/training/records/rows.h"
#include "palpate/training/session/class_part.h"
#include "palpate/training/session/session.h"

namespace palpate::classroom {

inline constexpr std::size_t kMaxLiveBytes = 200;
inline constexpr std::size_t kMaxMessageBytes = 4096;
/// A compressed row, as text: 64 kB that do not compress.
inline constexpr std::size_t kMaxRowMessageBytes = 100000;

struct Topic {
  std::string class_id;
  std::string station;
  std::string kind;  ///< "live", "trial", "ack", ...
};
std::string topicText(const Topic& topic);
/// Returns nothing if `text` is not a topic of a class.
std::optional<Topic> parseTopic(std::string_view text);
/// Tests whether rows would reach the database: acknowledged, and not stored.
inline constexpr std::string_view kCheckKind = "check";
/// Kinds that carry rows: "station", "class", "trainee", "protocol", "session", "block", "trial", "event", "delete".
bool isRowKind(std::string_view kind);

struct Envelope {
  std::uint64_t sequence = 0;  ///< counts the station's messages since it started
  training::Uuid id;           ///< row's id, else the current session's
  double monotonic_s = 0.0;    ///< the station's own clock: its differences mean something
};

/// By the clock of this moment.
Envelope makeEnvelope(std::uint64_t sequence, const training::Uuid& id);

/// Identity of a station while it is online.
struct StationStatus {
  bool online = false;
  std::string app;     ///< "palpate 0.9"
  std::string device;  ///< "mouse"; as the session has it
  std::string safety;  ///< "ok", or what stopped it
  friend bool operator==(const StationStatus&, const StationStatus&) = default;
};

/// Activity at a station, as its instructor sees it; never shown at the station.
struct StationState {
  training::Uuid session;
  training::Uuid trainee;  ///< the pseudonym
  training::SessionKind kind = training::SessionKind::practice;
  training::Screen screen = training::Screen::device_check;
  bool paused = false;
  int trial = 0;  ///< the current one; 0: none
  int trials_at_most = 0;
  double change = 0.0;  ///< in the current trial; 0: none, or hidden until the answer
  // T so far; 0: nothing is known yet.
  double threshold = 0.0, low = 0.0, high = 0.0;
  int wrong_in_a_row = 0;      ///< answers
  int sites_skipped = 0;       ///< in the last trial that was answered
  double palpate_force_n = 0;  ///< mean, of that trial; 0: none yet
  friend bool operator==(const StationState&, const StationState&) = default;
};
/// Fills in the state from a session.
StationState makeStationState(const training::Session& session);

/// The finger that presses hardest, ten times a second.
struct LiveSample {
  Vec3 finger_mm = Vec3::Zero();
  double force_n = 0.0;
  double depth_mm = 0.0;
  int site = 0;           ///< under it; 0: none
  int sites_pressed = 0;  ///< in this trial
  training::Screen phase = training::Screen::trial;
};

using CommandKind = training::InstructorAct;
using Command = training::InstructorCommand;
/// Older commands are ignored: the sender has already seen that nothing happened.
inline constexpr double kCommandExpiryS = 10.0;
inline constexpr std::size_t kMaxCommandText = 200;

struct RowMessage {
  Envelope envelope;  ///< `id`: the outbox key, which the acknowledgement names
  std::string body;   ///< JSON of the row; not yet read
};

template <class Content>
struct Message {
  Envelope envelope;
  Content content;
};

// Writing: one line of JSON.
std::string statusText(const Envelope& envelope, const StationStatus& status);
std::string stateText(const Envelope& envelope, const StationState& state);
std::string liveText(const Envelope& envelope, const LiveSample& live);
std::string rowText(const Envelope& envelope, const std::string& body);
std::string commandText(const Envelope& envelope, const Command& command);
/// Splits the keys into messages within the size limit.
std::vector<std::string> ackTexts(const Envelope& envelope, const std::vector<training::Uuid>& keys);
/// On the topic of acknowledgements too: rows that are not kept, for this reason.
std::vector<std::string> refusalTexts(const Envelope& envelope, const std::vector<training::Uuid>& keys,
                                      const std::string& why);
/// On the topic of acknowledgements too: trainees who were deleted for every station (training::deletedMark).
std::vector<std::string> deletionNoticeTexts(const Envelope& envelope, const std::vector<std::string>& marks);

// Readers return nothing for a text that is not such a message.
std::optional<Message<StationStatus>> parseStatus(std::string_view text);
std::optional<Message<StationState>> parseState(std::string_view text);
std::optional<Message<LiveSample>> parseLive(std::string_view text);
std::optional<RowMessage> parseRowMessage(std::string_view text);
std::optional<Message<Command>> parseCommand(std::string_view text);
std::optional<std::vector<training::Uuid>> parseAck(std::string_view text);
struct Refusal {
  std::vector<training::Uuid> keys;
  std::string why;
};
std::optional<Refusal> parseRefusal(std::string_view text);
std::optional<std::vector<std::string>> parseDeletionNotice(std::string_view text);

}  // namespace palpate::classroom

template <>
struct palpate::WordsOf<palpate::classroom::CommandKind> {
  using V = palpate::classroom::CommandKind;
  static constexpr std::array kAll = {Word{"pause", V::pause}, Word{"go_on", V::go_on}, Word{"message", V::message},
                                      Word{"next_block", V::next_block}};
};
