// Any bytes as a training protocol, and as the state of a block that was put down: settings, a block, or one Error.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "palpate/base/error.h"
#include "palpate/training/protocol.h"

namespace {

template <class Read>
void readOrRefuse(const Read& read) {
  try {
    read();
  } catch (const palpate::Error& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) __builtin_trap();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace palpate::training;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  readOrRefuse([&] {
    const Protocol protocol = parseProtocol(text, "fuzz.toml");
    // What was read is written so that it is read again.
    if (protocolText(parseProtocol(protocolText(protocol), "again.toml")) != protocolText(protocol)) __builtin_trap();
  });
  readOrRefuse([&] {
    Block block = Block::resumed(builtInProtocol().pre_test.block, text);
    if (!block.finished()) block.answer({.answer = 1});
  });
  return 0;
}
