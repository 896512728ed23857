// Any bytes as the datagrams of a conversation with the device `remote`, a line each: what moves the finger is finite,
// nobody gets more answers than his poses are worth, and with a key nothing moves that was not signed.
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "palpate/device/detail/remote_gate.h"
#include "palpate/device/trajectory.h"

namespace {

using namespace palpate::device;

constexpr RemotePeer kPeers[] = {{0x7f000001, 1}, {0x7f000001, 2}};

void require(bool holds) {
  if (!holds) __builtin_trap();
}

void converse(RemoteGate& gate, std::string_view text, bool keyed) {
  std::uint64_t tick = 0;
  std::uint64_t poses = 0;
  std::uint64_t answers = 0;
  while (!text.empty()) {
    // The first byte of a line: who sends it, and how long after the last.
    const auto first = static_cast<unsigned char>(text.front());
    text.remove_prefix(1);
    const std::size_t end = std::min(text.find('\n'), text.size());
    tick += first / 2;
    gate.tick(tick);
    const auto pose = gate.acceptPose(text.substr(0, end), kPeers[first % 2], tick);
    require(gate.reply().size() <= end);
    if (pose) {
      ++poses;
      require(!keyed && gate.holder() == kPeers[first % 2]);
      require(pose->tip_mm.cwiseAbs().maxCoeff() <= kMaxCoordinateMm);
    }
    for (std::uint64_t i = 0; i < 2 * kAnswersPerPose; ++i) answers += gate.answer({1, 2, 3}).empty() ? 0 : 1;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  require(answers <= poses * kAnswersPerPose);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  RemoteGate::Seed seed;
  seed.fill('0');
  RemoteGate open(std::nullopt, seed, 100);
  converse(open, text, false);
  RemoteGate keyed("0123456789abcdef0123456789abcdef", seed, 100);
  converse(keyed, text, true);
  return 0;
}
