#include "palpate/classroom/messages.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "palpate/base/base64.h"
#include "palpate/base/json.h"
#include "palpate/base/stopwatch.h"
#include "palpate/base/text.h"
#include "palpate/classroom/class_settings.h"
#include "palpate/training/records/row_check.h"
#include "palpate/training/records/row_json.h"

namespace palpate::classroom {

namespace {

using training::Screen;

constexpr std::string_view kTopicRoot = "palpate/v1";
constexpr std::array<std::string_view, 9> kRowKinds = {"station", "class", "trainee", "protocol", "session",
                                                       "block",   "trial", "event",   "delete"};
constexpr std::array kScreenWords = {
    Word{"device_check", Screen::device_check}, Word{"familiarisation", Screen::familiarisation},
    Word{"instruction", Screen::instruction},   Word{"trial", Screen::trial},
    Word{"feedback", Screen::feedback},         Word{"block_summary", Screen::block_summary},
    Word{"free", Screen::free_exploration},     Word{"finished", Screen::finished}};
constexpr double kLongestMonotonicS = 1e10;  // 300 years
constexpr double kFarthestFingerMm = 9999.0;
constexpr double kMaxLiveForceN = 999.0;
constexpr int kMaxSites = 40;
constexpr int kMaxTrials = 100000;
constexpr std::size_t kMaxStatusText = 400;  // a device's name is not longer
/// A row's text that is longer travels compressed; with its envelope it then still fits.
constexpr std::size_t kMaxPlainRow = kMaxMessageBytes - 150;
constexpr std::size_t kKeysInAck = 90;
constexpr std::size_t kMarksInMessage = 55;
constexpr std::size_t kMaxWhy = 300;

std::string screenWord(Screen screen) {
  const auto* const found = std::ranges::find(kScreenWords, screen, &Word<Screen>::value);
  return std::string(found == kScreenWords.end() ? "finished" : found->word);
}
std::optional<Screen> screenNamed(std::string_view word) {
  const auto* const found = std::ranges::find(kScreenWords, word, &Word<Screen>::word);
  return found == kScreenWords.end() ? std::nullopt : std::optional(found->value);
}

/// Finite and small enough that a message keeps its size.
double within(double value, double most) { return std::isfinite(value) ? std::clamp(value, -most, most) : 0.0; }
double rounded(double value, double most, double steps) { return std::round(within(value, most) * steps) / steps; }

Json enveloped(const Envelope& envelope) {
  return {{"seq", envelope.sequence}, {"id", envelope.id}, {"t", rounded(envelope.monotonic_s, 1e9, 1000.0)}};
}
std::string toLine(const Json& message) { return jsonDump(message); }

std::string shortened(const std::string& text, std::size_t most) {
  std::size_t end = std::min(text.size(), most);
  while (end > 0 && end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return text.substr(0, end);
}

/// Reads the members of a message, all of which must exist and have the right type; faults are reported at the end.
class MessageReader {
 public:
  MessageReader(std::string_view text, std::size_t most_bytes) {
    if (text.size() <= most_bytes) object_ = Json::tryParse(text);
    good_ = object_.is_object();
  }

  const Json* member(const char* name) {
    if (!good_) return nullptr;
    const auto found = object_.find(name);
    good_ = found != object_.end();
    used_ += good_ ? 1U : 0U;
    return good_ ? &*found : nullptr;
  }
  bool has(const char* name) const { return good_ && object_.contains(name); }

  double number(const char* name, double low, double high) {
    const Json* value = member(name);
    return value == nullptr ? 0.0 : number(*value, low, high);
  }
  double number(const Json& value, double low, double high) {
    const double read = value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
    if (!(read >= low && read <= high)) good_ = false;
    return good_ ? read : 0.0;
  }
  int whole(const char* name, int low, int high) {
    const Json* value = member(name);
    if (value == nullptr) return 0;
    if (!value->is_number_integer()) good_ = false;
    return static_cast<int>(number(*value, low, high));
  }
  std::string text(const char* name, std::size_t most) {
    const Json* value = member(name);
    if (value == nullptr) return {};
    if (!value->is_string() || value->text().size() > most) good_ = false;
    return good_ ? value->get<std::string>() : std::string();
  }
  bool truth(const char* name) {
    const Json* value = member(name);
    if (value == nullptr) return false;
    if (!value->is_boolean()) good_ = false;
    return good_ && value->get<bool>();
  }
  training::Uuid uuid(const char* name) {
    std::string id = text(name, 36);
    if (!training::isUuid(id)) good_ = false;
    return id;
  }
  template <class Value>
  Value word(const char* name) {
    const auto named = valueNamed<Value>(text(name, 32));
    if (!named) good_ = false;
    return named.value_or(Value{});
  }
  Screen screen(const char* name) {
    const auto named = screenNamed(text(name, 32));
    if (!named) good_ = false;
    return named.value_or(Screen::finished);
  }
  Envelope envelope() {
    Envelope read;
    const Json* sequence = member("seq");
    if (sequence != nullptr && !sequence->is_number_unsigned()) good_ = false;
    if (good_) read.sequence = sequence->get<std::uint64_t>();
    read.id = uuid("id");
    read.monotonic_s = number("t", -kLongestMonotonicS, kLongestMonotonicS);
    return read;
  }

  std::vector<std::string> list(const char* name, bool (*is_one)(std::string_view)) {
    std::vector<std::string> read;
    const Json* values = member(name);
    good_ = good_ && values->is_array();
    if (!good_) return read;
    for (const Json& value : *values) {
      good_ = good_ && value.is_string() && is_one(value.text());
      if (!good_) return {};
      read.push_back(value.get<std::string>());
    }
    return read;
  }

  void refuse() { good_ = false; }
  /// Everything was as it should be, and nothing else was there.
  bool good() const { return good_ && used_ == object_.size(); }

 private:
  Json object_;
  bool good_ = false;
  std::size_t used_ = 0;
};

template <class Content>
std::optional<Message<Content>> makeMessage(const MessageReader& reader, Envelope envelope, Content content) {
  if (!reader.good()) return std::nullopt;
  return Message<Content>{std::move(envelope), std::move(content)};
}

std::string packed(const std::string& text) {
  uLongf size = compressBound(static_cast<uLong>(text.size()));
  std::string bytes(size, '\0');
  compress2(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(text.data()),
            static_cast<uLong>(text.size()), Z_BEST_COMPRESSION);
  bytes.resize(size);
  return base64(bytes);
}

/// Limited to a row's size: a few bytes could else become a gigabyte.
std::optional<std::string> unpacked(const std::string& text) {
  const auto bytes = bytesOfBase64(text);
  if (!bytes) return std::nullopt;
  std::string row(training::kLongestRowJson, '\0');
  uLongf size = row.size();
  if (uncompress(reinterpret_cast<Bytef*>(row.data()), &size, reinterpret_cast<const Bytef*>(bytes->data()),
                 static_cast<uLong>(bytes->size())) != Z_OK) {
    return std::nullopt;
  }
  row.resize(size);
  return row;
}

/// Splits a list into as many messages as needed.
std::vector<std::string> listTexts(const Json& head, const char* name, const std::vector<std::string>& values,
                                   std::size_t in_one) {
  std::vector<std::string> texts;
  for (std::size_t begin = 0; begin < values.size(); begin += in_one) {
    const std::size_t end = std::min(values.size(), begin + in_one);
    Json message = head;
    message[name] = Json::array();
    for (std::size_t i = begin; i < end; ++i) message[name].push_back(values[i]);
    texts.push_back(toLine(message));
  }
  return texts;
}

int wrongInARow(const std::vector<training::TrialRow>& trials) {
  const auto right = std::find_if(trials.rbegin(), trials.rend(), [](const auto& trial) { return trial.correct; });
  return static_cast<int>(right - trials.rbegin());
}

}  // namespace

std::string topicText(const Topic& topic) {
  return fmt::format("{}/{}/st/{}/{}", kTopicRoot, topic.class_id, topic.station, topic.kind);
}

std::optional<Topic> parseTopic(std::string_view text) {
  if (text.size() > kMaxLiveBytes) return std::nullopt;
  const auto parts = split(text, '/');
  if (parts.size() != 6 || parts[0] != "palpate" || parts[1] != "v1" || parts[3] != "st") return std::nullopt;
  Topic topic{std::string(parts[2]), std::string(parts[4]), std::string(parts[5])};
  const bool may_send = isStationName(topic.station) ||
                        (topic.station == wordFor(Role::instructor) && topic.kind == "delete") ||
                        (topic.station == wordFor(Role::checker) && (topic.kind == kCheckKind || topic.kind == "ack"));
  if (!isClassWord(topic.class_id) || !may_send || !isClassWord(topic.kind)) return std::nullopt;
  return topicText(topic) == text ? std::optional(topic) : std::nullopt;
}

bool isRowKind(std::string_view kind) { return std::ranges::find(kRowKinds, kind) != kRowKinds.end(); }

StationState makeStationState(const training::Session& session) {
  StationState state;
  state.session = session.plan().row.id;
  state.trainee = session.plan().row.trainee_id;
  state.kind = session.plan().kind;
  state.screen = session.screen();
  state.paused = session.paused();
  state.trial = state.screen == Screen::trial ? session.trialNumber() : 0;
  state.trials_at_most = session.trialsAtMost();
  if (const auto hidden = session.hidden()) state.change = hidden->change;
  if (const auto result = session.result()) {
    state.threshold = result->threshold.median;
    state.low = result->threshold.low;
    state.high = result->threshold.high;
  }
  const auto& trials = session.trials();
  state.wrong_in_a_row = wrongInARow(trials);
  if (!trials.empty()) {
    state.sites_skipped = std::max(0, session.plan().sites.choices() - trials.back().sites_felt);
    state.palpate_force_n = trials.back().palpate_force_n;
  }
  return state;
}

Envelope makeEnvelope(std::uint64_t sequence, const training::Uuid& id) {
  return {sequence, id, std::chrono::duration<double>(Clock::now().time_since_epoch()).count()};
}

std::string statusText(const Envelope& envelope, const StationStatus& status) {
  Json message = enveloped(envelope);
  message["online"] = status.online;
  message["app"] = shortened(status.app, 100);
  message["device"] = shortened(status.device, kMaxStatusText);
  message["safety"] = shortened(status.safety, kMaxStatusText);
  return toLine(message);
}

std::optional<Message<StationStatus>> parseStatus(std::string_view text) {
  MessageReader reader(text, kMaxMessageBytes);
  Envelope envelope = reader.envelope();
  StationStatus status;
  status.online = reader.truth("online");
  status.app = reader.text("app", 100);
  status.device = reader.text("device", kMaxStatusText);
  status.safety = reader.text("safety", kMaxStatusText);
  return makeMessage(reader, std::move(envelope), std::move(status));
}

std::string stateText(const Envelope& envelope, const StationState& state) {
  Json message = enveloped(envelope);
  message["sitting"] = state.session;
  message["trainee"] = state.trainee;
  message["kind"] = wordFor(state.kind);
  message["screen"] = screenWord(state.screen);
  message["paused"] = state.paused;
  message["trial"] = state.trial;
  message["most"] = state.trials_at_most;
  message["change"] = rounded(state.change, 1.0, 1e4);
  message["T"] = {rounded(state.threshold, 9.0, 1e4), rounded(state.low, 9.0, 1e4), rounded(state.high, 9.0, 1e4)};
  message["wrong"] = state.wrong_in_a_row;
  message["skipped"] = state.sites_skipped;
  message["force"] = rounded(state.palpate_force_n, kMaxLiveForceN, 100.0);
  return toLine(message);
}

std::optional<Message<StationState>> parseState(std::string_view text) {
  MessageReader reader(text, kMaxMessageBytes);
  Envelope envelope = reader.envelope();
  StationState state;
  state.session = reader.uuid("sitting");
  state.trainee = reader.uuid("trainee");
  state.kind = reader.word<training::SessionKind>("kind");
  state.screen = reader.screen("screen");
  state.paused = reader.truth("paused");
  state.trial = reader.whole("trial", 0, kMaxTrials);
  state.trials_at_most = reader.whole("most", 0, kMaxTrials);
  state.change = reader.number("change", 0.0, 1.0);
  if (const Json* t = reader.member("T"); t != nullptr && t->is_array() && t->size() == 3) {
    state.threshold = reader.number((*t)[0], 0.0, 9.0);
    state.low = reader.number((*t)[1], 0.0, 9.0);
    state.high = reader.number((*t)[2], 0.0, 9.0);
  } else {
    reader.refuse();
  }
  state.wrong_in_a_row = reader.whole("wrong", 0, kMaxTrials);
  state.sites_skipped = reader.whole("skipped", 0, kMaxSites);
  state.palpate_force_n = reader.number("force", 0.0, kMaxLiveForceN);
  return makeMessage(reader, std::move(envelope), std::move(state));
}

std::string liveText(const Envelope& envelope, const LiveSample& live) {
  Json message = enveloped(envelope);
  const auto place = [&](int axis) { return rounded(live.finger_mm[axis], kFarthestFingerMm, 10.0); };
  message["p"] = {place(0), place(1), place(2)};
  message["f"] = rounded(live.force_n, kMaxLiveForceN, 100.0);
  message["d"] = rounded(live.depth_mm, kMaxLiveForceN, 10.0);
  message["s"] = std::clamp(live.site, 0, kMaxSites);
  message["n"] = std::clamp(live.sites_pressed, 0, kMaxSites);
  message["ph"] = screenWord(live.phase);
  return toLine(message);
}

std::optional<Message<LiveSample>> parseLive(std::string_view text) {
  MessageReader reader(text, kMaxLiveBytes);
  Envelope envelope = reader.envelope();
  LiveSample live;
  if (const Json* place = reader.member("p"); place != nullptr && place->is_array() && place->size() == 3) {
    for (int axis = 0; axis < 3; ++axis) {
      live.finger_mm[axis] =
          reader.number((*place)[static_cast<std::size_t>(axis)], -kFarthestFingerMm, kFarthestFingerMm);
    }
  } else {
    reader.refuse();
  }
  live.force_n = reader.number("f", -kMaxLiveForceN, kMaxLiveForceN);
  live.depth_mm = reader.number("d", -kMaxLiveForceN, kMaxLiveForceN);
  live.site = reader.whole("s", 0, kMaxSites);
  live.sites_pressed = reader.whole("n", 0, kMaxSites);
  live.phase = reader.screen("ph");
  return makeMessage(reader, std::move(envelope), live);
}

std::string rowText(const Envelope& envelope, const std::string& body) {
  std::string head = toLine(enveloped(envelope));
  head.pop_back();
  if (body.size() <= kMaxPlainRow) return head + ",\"row\":" + body + "}";
  return head + ",\"z\":\"" + packed(body) + "\"}";
}

std::optional<RowMessage> parseRowMessage(std::string_view text) {
  MessageReader reader(text, kMaxRowMessageBytes);
  RowMessage message{reader.envelope(), {}};
  if (reader.has("z")) {
    auto row = unpacked(reader.text("z", kMaxRowMessageBytes));
    if (!row) return std::nullopt;
    message.body = std::move(*row);
  } else if (const Json* row = reader.member("row"); row != nullptr) {
    if (!row->is_object()) return std::nullopt;
    message.body = toLine(*row);
  }
  return reader.good() ? std::optional(std::move(message)) : std::nullopt;
}

std::string commandText(const Envelope& envelope, const Command& command) {
  Json message = enveloped(envelope);
  message["do"] = wordFor(command.kind);
  message["text"] = shortened(command.text, kMaxCommandText);
  return toLine(message);
}

std::optional<Message<Command>> parseCommand(std::string_view text) {
  MessageReader reader(text, kMaxMessageBytes);
  Envelope envelope = reader.envelope();
  Command command;
  command.kind = reader.word<CommandKind>("do");
  command.text = reader.text("text", kMaxCommandText);
  return makeMessage(reader, std::move(envelope), std::move(command));
}

std::vector<std::string> ackTexts(const Envelope& envelope, const std::vector<training::Uuid>& keys) {
  return listTexts(enveloped(envelope), "rows", keys, kKeysInAck);
}

std::vector<std::string> refusalTexts(const Envelope& envelope, const std::vector<training::Uuid>& keys,
                                      const std::string& why) {
  Json head = enveloped(envelope);
  head["why"] = shortened(why, kMaxWhy);
  return listTexts(head, "refused", keys, kKeysInAck);
}

std::vector<std::string> deletionNoticeTexts(const Envelope& envelope, const std::vector<std::string>& marks) {
  return listTexts(enveloped(envelope), "deleted", marks, kMarksInMessage);
}

std::optional<std::vector<training::Uuid>> parseAck(std::string_view text) {
  MessageReader reader(text, kMaxMessageBytes);
  reader.envelope();
  std::vector<training::Uuid> keys = reader.list("rows", training::isUuid);
  return reader.good() ? std::optional(std::move(keys)) : std::nullopt;
}

std::optional<Refusal> parseRefusal(std::string_view text) {
  MessageReader reader(text, kMaxMessageBytes);
  reader.envelope();
  Refusal refusal;
  refusal.why = reader.text("why", kMaxWhy);
  refusal.keys = reader.list("refused", training::isUuid);
  return reader.good() ? std::optional(std::move(refusal)) : std::nullopt;
}

std::optional<std::vector<std::string>> parseDeletionNotice(std::string_view text) {
  MessageReader reader(text, kMaxMessageBytes);
  reader.envelope();
  std::vector<std::string> marks = reader.list("deleted", training::isHash);
  return reader.good() ? std::optional(std::move(marks)) : std::nullopt;
}

}  // namespace palpate::classroom
