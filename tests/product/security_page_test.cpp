// docs/reference/security.md stays true: its table of ports and limits is that of the code.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "cli/serve/finger_control.h"
#include "cli/serve/hall.h"
#include "palpate/base/text.h"
#include "palpate/classroom/class_settings.h"
#include "palpate/classroom/messages.h"
#include "palpate/classroom/row_keeper.h"
#include "palpate/device/detail/remote_device.h"
#include "palpate/device/detail/remote_gate.h"
#include "palpate/device/device_profile.h"
#include "palpate/measure/photograph.h"
#include "palpate/scene/detail/toml_node.h"
#include "palpate/scene/scene_file.h"
#include "palpate/servo/device_limits.h"
#include "support/places.h"

namespace palpate {
namespace {

struct LimitRow {
  std::string where, what, value;
};

static_assert(scene::kMaxTomlKeyParts == scene::kMaxTomlNesting, "one row says both");

std::vector<LimitRow> limitRows() {
  using namespace device;
  namespace serving = app::serving;
  const serving::NetworkSettings serve;
  const serving::VisitLimits visits;
  const serving::ControlLimits control;
  return {
      {"`--device remote`", "port, UDP", fmt::format("{}", kRemotePort)},
      {"`--device remote`", "listens at, unless told otherwise", kRemoteAddress},
      {"`--device remote`", "bytes of a message", fmt::format("{}", kMaxDatagramBytes)},
      {"`--device remote`", "messages read in a tick", fmt::format("{}", kMaxDatagramsPerTick)},
      {"`--device remote`", "answers to a pose", fmt::format("{}", kAnswersPerPose)},
      {"`--device remote`", "silence until another may have the finger, s", fmt::format("{}", kHandoverS)},
      {"`--device remote`", "letters of a key", fmt::format("{} to {}", kMinKeyBytes, kMaxKeyBytes)},
      {"`serve`", "port, TCP", fmt::format("{}", serve.port)},
      {"`serve`", "listens at, unless told otherwise", serve.host},
      {"`serve`", "connections without a token", fmt::format("{}", visits.strangers)},
      {"`serve`", "of them of one address beyond loopback", fmt::format("{}", visits.strangers_of_one)},
      {"`serve`", "connections with a token", fmt::format("{}", visits.known)},
      {"`serve`", "viewers", fmt::format("{}", serve.watchers)},
      {"`serve`", "bytes of a request's head", fmt::format("{}", serving::kMaxHeaderBytes)},
      {"`serve`", "time for a request, TLS included, s", fmt::format("{}", serve.handshake_s)},
      {"`serve`", "time for a piece of an answer to be taken, s", fmt::format("{}", serve.piece_s)},
      {"`serve`", "bytes of such a piece", fmt::format("{}", serving::kPieceBytes)},
      {"`serve`", "silence of a viewer, s", fmt::format("{}", serve.silence_s)},
      {"`serve`", "time in which a viewer must take something, s", fmt::format("{}", serve.stall_s)},
      {"`serve`", "bytes of a page's message", fmt::format("{}", serving::kMaxRequestBytes)},
      {"`serve`", "messages of a page in a second", fmt::format("{}", serving::kMaxRequestsPerS)},
      {"`serve`", "force of a page's finger, N", fmt::format("{}", control.force_n)},
      {"`serve`", "silence until a page's finger is lifted, s", fmt::format("{}", control.silence_s)},
      {"`class`", "port of the broker, TCP with TLS", fmt::format("{}", classroom::kStandardPort)},
      {"`class`", "bytes of a message", fmt::format("{}", classroom::kMaxMessageBytes)},
      {"`class`", "bytes of a row's message", fmt::format("{}", classroom::kMaxRowMessageBytes)},
      {"`class`", "a row may be dated after now by, s", fmt::format("{}", classroom::kClockSkewMs / 1000)},
      {"`class`", "disk of a station between two purges, MB", fmt::format("{}", classroom::kStationBytes >> 20)},
      {"device", "force where its type is unknown, N", fmt::format("{}", DeviceProfile{}.force_n)},
      {"device", "how far a scene may loosen a guard, times its default", fmt::format("{}", servo::kLoosestGuard)},
      {"device", "quickest ramp of a start inside, s", fmt::format("{}", servo::kQuickestRampS)},
      {"files", "bytes of a scene", fmt::format("{}", scene::kMaxSceneBytes)},
      {"files", "parts of a key, and brackets within brackets, of a TOML file",
       fmt::format("{}", scene::kMaxTomlKeyParts)},
      {"files", "pixels of a photograph", fmt::format("{}", measure::kMaxPixels)},
  };
}

TEST(SecurityPage, TableOfPortsAndLimitsIsThatOfTheCode) {
  std::string table;
  for (const LimitRow& row : limitRows()) table += fmt::format("| {} | {} | {} |\n", row.where, row.what, row.value);
  const std::string page = readFile(support::sourceFolder() / "docs/reference/security.md", 1 << 20);
  const std::string head = "| where | what | value |\n|---|---|---|\n";
  const std::size_t begin = page.find(head);
  ASSERT_NE(begin, std::string::npos);
  const std::size_t rows = begin + head.size();
  EXPECT_EQ(page.substr(rows, page.find("\n\n", rows) + 1 - rows), table) << "docs/reference/security.md should have\n"
                                                                          << table;
}

}  // namespace
}  // namespace palpate
