// Any bytes as a message of a class, each kind: nothing, or what can be written and read again; and as a topic.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "palpate/classroom/class_watch.h"
#include "palpate/classroom/messages.h"

namespace {

using namespace palpate::classroom;

/// What was read says the same when it is written and read again.
template <class Parse, class Write>
void comesBack(std::string_view text, const Parse& parse, const Write& write) {
  const auto read = parse(text);
  if (!read) return;
  const std::string again = write(read->envelope, read->content);
  const auto twice = parse(again);
  if (!twice || write(twice->envelope, twice->content) != again) __builtin_trap();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  comesBack(text, parseLive, liveText);
  comesBack(text, parseState, stateText);
  comesBack(text, parseStatus, statusText);
  comesBack(text, parseCommand, commandText);
  if (const auto live = parseLive(text); live && !live->content.finger_mm.allFinite()) __builtin_trap();
  if (const auto row = parseRowMessage(text); row && row->body.size() > 200'000) __builtin_trap();
  if (const auto keys = parseAck(text)) {
    for (const auto& key : *keys) {
      if (key.size() != 36) __builtin_trap();
    }
  }
  if (const auto topic = parseTopic(text); topic && topicText(*topic) != text) __builtin_trap();

  ClassBoard board("c");
  double now_s = 0.0;
  for (const char* kind : {"status", "state", "live", "block", "session", "trial"}) {
    board.acceptMessage(topicText({"c", "s01", kind}), text, now_s += 1.0);
  }
  if (board.tiles(now_s).size() != 1) __builtin_trap();
  return 0;
}
