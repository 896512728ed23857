// Any bytes as rows that a station sends, through the collector's checks into records: nothing of another station's is
// changed, whatever arrives, and what is wrong is said in one line. The first byte of each line says which kind it is.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "palpate/classroom/class_settings.h"
#include "palpate/classroom/messages.h"
#include "palpate/classroom/row_keeper.h"
#include "palpate/training/records/store.h"

namespace {

using namespace palpate;
using namespace palpate::classroom;

constexpr const char* kIds[] = {"018f3c1e-0000-7000-8000-000000000001", "018f3c1e-0000-7000-8000-000000000002"};

/// What s01 has sent: a trainee with a session.
std::vector<SentRow> ownedRows() {
  const training::Uuid s01 = deriveStationId("c", "s01");
  training::TraineeRow trainee;
  trainee.id = kIds[0];
  trainee.class_id = "c";
  training::SessionRow session;
  session.id = kIds[1];
  session.trainee_id = kIds[0];
  session.station_id = s01;
  return {{training::StationRow{s01, "s01", "", "", 0}, s01, "s01", 100},
          {trainee, s01, "s01", 100},
          {session, s01, "s01", 100}};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  training::Store store = training::Store::inMemory("fuzz");
  RowKeeper keeper(store.rows(), {"c", 1 << 20});
  const std::vector<SentRow> owned = ownedRows();
  if (keeper.save(owned).keys.size() != owned.size()) __builtin_trap();

  constexpr const char* kKinds[] = {"station", "class", "trainee", "protocol", "session",
                                    "block",   "trial", "event",   "delete"};
  const training::Uuid s02 = deriveStationId("c", "s02");
  std::vector<SentRow> sent;
  for (const std::string_view line : split({reinterpret_cast<const char*>(data), size}, '\n')) {
    if (line.empty() || sent.size() > 20) continue;
    std::string body(line.substr(1));
    if (const auto message = parseRowMessage(body)) body = message->body;
    try {
      const char* kind = kKinds[static_cast<unsigned char>(line[0]) % std::size(kKinds)];
      sent.push_back({training::rowFromJson(kind, body), s02, "s02", body.size()});
    } catch (const Error& error) {
      if (std::string_view(error.what()).find('\n') != std::string_view::npos) __builtin_trap();
    }
  }
  const KeptRows kept = keeper.save(sent);
  if (kept.fates.size() != sent.size()) __builtin_trap();
  for (const auto* list : {&kept.waits, &kept.refused}) {
    for (const NotKept& row : *list) {
      if (row.why.empty() || row.why.find('\n') != std::string::npos) __builtin_trap();
    }
  }
  const auto trainee = store.trainee(kIds[0]);
  const auto session = store.rows().session(kIds[1]);
  const bool whole = trainee && session && training::rowJson(*trainee) == training::rowJson(owned[1].row) &&
                     training::rowJson(*session) == training::rowJson(owned[2].row);
  if (!whole) __builtin_trap();
  return 0;
}
