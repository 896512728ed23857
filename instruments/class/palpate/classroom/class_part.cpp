#include "palpate/classroom/class_part.h"

#include <memory>

#include "palpate/classroom/class_folder.h"
#include "palpate/classroom/class_line.h"
#include "palpate/classroom/class_settings.h"
#include "palpate/classroom/class_store.h"
#include "palpate/classroom/database_copy.h"
#include "palpate/training/records/trainee_code.h"

namespace palpate::classroom {

namespace {

training::ClassLink connectStation(const Member& member, training::Store& store, const StationInfo& info) {
  const auto line = std::make_shared<ClassLine>(member, store, info);
  return {.felt = [line](const trace::Sample& sample) { line->update(sample); },
          .follow = [line](const training::Session* session) { line->follow(session); },
          .publish_safety = [line](const std::string& words) { line->publishSafety(words); },
          .pop_command = [line] { return line->popCommand(); }};
}

training::ClassStation stationIn(const std::filesystem::path& folder) {
  const Member member = readMember(folder);
  training::ClassStation station;
  station.of = {member.class_id, member.class_id, member.retention.days, member.retention.samples_days};
  station.row.id = member.station_id;
  station.row.name = member.name;
  station.trainee_key = member.trainee_key;
  station.connect = [member](training::Store& store, const std::string& app, const std::string& device) {
    return connectStation(member, store, {app, device});
  };
  return station;
}

training::ClassSecret secretIn(const std::filesystem::path& folder) {
  if (std::filesystem::exists(folder / "class.toml")) {
    const ClassFolder read = readClassFolder(folder);
    return {read.class_id, read.trainee_key};
  }
  const Member member = readMember(folder);
  return {member.class_id, member.trainee_key};
}

training::ErasedFromDatabase eraseFromDatabase(const std::string& address, const training::Uuid& trainee,
                                               std::string_view actor) {
  ClassStore database(address);
  const bool found = database.erase(trainee, actor);
  return {found, database.notErased()};
}

training::PurgedFromDatabase purgeDatabase(const std::string& address, std::int64_t now_ms) {
  ClassStore database(address);
  const training::Purged purged = database.purge(now_ms);
  return {purged, database.notErased()};
}

void noteInDatabase(const std::string& address, std::string_view actor, std::string_view what,
                    const std::string& detail) {
  ClassStore database(address);
  database.rows().note(training::utcMs(), actor, what, detail);
}

}  // namespace

training::ClassPart makeClassPart() {
  return {.station = stationIn,
          .secret = secretIn,
          .copy_of_database = copyOfDatabase,
          .erase = eraseFromDatabase,
          .purge = purgeDatabase,
          .note = noteInDatabase};
}

}  // namespace palpate::classroom
