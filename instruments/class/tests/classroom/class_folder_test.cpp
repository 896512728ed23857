// The folder of a class: what is made can be read back, keys are their owner's alone, nothing is overwritten, and the
// certificates are what they should be by OpenSSL's own program.
#include "palpate/classroom/class_folder.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "palpate/base/error.h"
#include "palpate/base/text.h"
#include "palpate/classroom/certificates.h"
#include "support/error_message.h"
#include "support/run_command.h"
#include "support/temporary_folder.h"

namespace palpate::classroom {
namespace {

using support::TemporaryFolder;

ClassPlan aPlan(int stations = 3) {
  ClassPlan plan;
  plan.class_id = "osteo-1";
  plan.label = "Osteopathy, first year";
  plan.stations = stations;
  plan.hosts = {"teacher.local", "192.168.1.10"};
  plan.port = 18883;
  return plan;
}

mode_t modeOf(const std::filesystem::path& file) {
  struct stat found {};
  EXPECT_EQ(stat(file.c_str(), &found), 0) << file;
  return found.st_mode & 0777U;
}

TEST(ClassFolderTest, WhatWasMadeIsReadBack) {
  const TemporaryFolder temporary;
  makeClassFolder(temporary / "class", aPlan());
  const ClassFolder read = readClassFolder(temporary / "class");
  EXPECT_EQ(read.class_id, "osteo-1");
  EXPECT_EQ(read.label, "Osteopathy, first year");
  EXPECT_EQ(read.host, "teacher.local");
  EXPECT_EQ(read.port, 18883);
  EXPECT_EQ(read.stations, (std::vector<std::string>{"s01", "s02", "s03"}));
  const Member station = readMember(read.station("s02"));
  EXPECT_EQ(station.role, Role::station);
  EXPECT_EQ(station.name, "s02");
  EXPECT_EQ(station.station_id, deriveStationId("osteo-1", "s02"));
  EXPECT_EQ(station.host, "teacher.local");
  EXPECT_TRUE(station.key.is_absolute());
  EXPECT_EQ(readMember(read.instructor()).role, Role::instructor);
  EXPECT_EQ(readMember(read.ingest() / "ingest.toml").role, Role::ingest);
}

TEST(ClassFolderTest, SaysForHowLongThingsAreKept) {
  const TemporaryFolder temporary;
  ClassPlan plan = aPlan();
  plan.retention = {.days = 730, .samples_days = 14};
  const ClassFolder made = makeClassFolder(temporary / "class", plan);
  addStation(made, "late");
  const ClassFolder read = readClassFolder(temporary / "class");
  EXPECT_EQ(read.retention, plan.retention);
  EXPECT_EQ(readMember(read.station("s02")).retention, plan.retention);
  EXPECT_EQ(readMember(read.station("late")).retention, plan.retention);
  const std::filesystem::path file = temporary / "class" / "class.toml";
  writeFile(file, "id = \"osteo-1\"\nhost = \"localhost\"\n");  // as of before there was a word for it
  EXPECT_EQ(readClassFolder(temporary / "class").retention, Retention());
  writeFile(file, "id = \"osteo-1\"\nhost = \"localhost\"\nretain_days = 0\n");
  const std::string words = support::thrownMessage([&] { readClassFolder(temporary / "class"); });
  EXPECT_NE(words.find("retain_days"), std::string::npos) << words;
}

TEST(ClassFolderTest, KeysAreTheirOwnersAlone) {
  const TemporaryFolder temporary;
  const ClassFolder made = makeClassFolder(temporary / "class", aPlan(1));
  int keys = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(made.folder)) {
    if (entry.path().extension() != ".key") continue;
    ++keys;
    EXPECT_EQ(modeOf(entry.path()), 0600U) << entry.path();
  }
  EXPECT_EQ(keys, 8);  // authority, broker, instructor, collector, checker, one station; the secret, there and here
  EXPECT_EQ(modeOf(made.folder), 0700U);
}

TEST(ClassFolderTest, NothingIsOverwritten) {
  const TemporaryFolder temporary;
  const ClassFolder made = makeClassFolder(temporary / "class", aPlan(1));
  const std::string before = support::contentOf(made.station("s01") / "station.key");
  EXPECT_THROW(makeClassFolder(made.folder, aPlan(1)), Error);
  EXPECT_THROW(addStation(made, "s01"), Error);
  EXPECT_EQ(support::contentOf(made.station("s01") / "station.key"), before);
}

TEST(ClassFolderTest, AStationMoreIsAddedByNumberOrName) {
  const TemporaryFolder temporary;
  const ClassFolder made = makeClassFolder(temporary / "class", aPlan(2));
  EXPECT_EQ(addStation(made), "s03");
  EXPECT_EQ(addStation(made, "by-the-window"), "by-the-window");
  EXPECT_EQ(readMember(made.station("by-the-window")).station_id, deriveStationId("osteo-1", "by-the-window"));
  for (const char* name : {"instructor", "ingest", "checker", "../s09", "a+b", "#", "S01", "-x"}) {
    EXPECT_THROW(addStation(made, name), Error) << name;
  }
}

TEST(ClassFolderTest, AStationThatIsRemovedLeavesItsNameFreeAndItsNumberOnTheList) {
  const TemporaryFolder temporary;
  const ClassFolder made = makeClassFolder(temporary / "class", aPlan(3));
  const auto serial_of = [](const std::filesystem::path& certificate) {
    const std::string out =
        support::runProgram("/usr/bin/openssl", "x509 -noout -serial -in " + certificate.string()).out;
    return out.substr(out.find('=') + 1, 32);
  };
  std::vector<std::string> serials = {serial_of(made.station("s02") / "station.crt")};
  removeStation(made, "s02");
  EXPECT_EQ(readClassFolder(made.folder).stations, (std::vector<std::string>{"s01", "s03"}));
  EXPECT_EQ(addStation(made, "s02"), "s02");
  serials.push_back(serial_of(made.station("s02") / "station.crt"));
  removeStation(made, "s02");
  const auto list = support::runProgram("/usr/bin/openssl", "crl -noout -text -CAfile " +
                                                                (made.folder / "authority/ca.crt").string() + " -in " +
                                                                made.revocationList().string());
  EXPECT_EQ(list.exit_code, 0) << list.err;
  EXPECT_NE(list.err.find("verify OK"), std::string::npos) << list.err;
  for (const std::string& serial : serials) EXPECT_NE(list.out.find(serial), std::string::npos) << list.out;
  EXPECT_EQ(list.out.find(serial_of(made.station("s01") / "station.crt")), std::string::npos);
  for (const char* name : {"s02", "s09", "../s01", "instructor", ""}) EXPECT_THROW(removeStation(made, name), Error);
  EXPECT_FALSE(std::filesystem::exists(made.folder / "revoked/s02-2/station.key"));
}

TEST(ClassFolderTest, CertificatesAreWhatOpenSslSaysTheyShouldBe) {
  const TemporaryFolder temporary;
  const ClassFolder made = makeClassFolder(temporary / "class", aPlan(1));
  const auto openssl = [&](const std::string& arguments) {
    return support::runProgram("openssl", arguments, made.folder);
  };
  EXPECT_EQ(openssl("verify -CAfile authority/ca.crt -purpose sslclient stations/s01/station.crt").exit_code, 0);
  EXPECT_EQ(openssl("verify -CAfile authority/ca.crt -purpose sslserver broker/server.crt").exit_code, 0);
  EXPECT_NE(openssl("verify -CAfile authority/ca.crt -purpose sslserver stations/s01/station.crt").exit_code, 0)
      << "a station could play the broker";
  EXPECT_EQ(openssl("verify -CAfile authority/ca.crt -verify_hostname teacher.local broker/server.crt").exit_code, 0);
  EXPECT_EQ(openssl("verify -CAfile authority/ca.crt -verify_ip 192.168.1.10 broker/server.crt").exit_code, 0);
  EXPECT_NE(openssl("verify -CAfile authority/ca.crt -verify_hostname other.local broker/server.crt").exit_code, 0);
  const std::string station = openssl("x509 -in stations/s01/station.crt -noout -text").out;
  EXPECT_NE(station.find("CN = s01"), std::string::npos) << station;
  EXPECT_NE(station.find("P-256"), std::string::npos) << station;
  const int days = daysLeft(support::contentOf(made.station("s01") / "station.crt"));
  EXPECT_NEAR(days, kMemberDays, 1);
}

TEST(ClassFolderTest, MemberFilesSayWhatIsWrongAndWhere) {
  const std::filesystem::path file = "/somewhere/station.toml";
  const std::string good = memberText(parseMember(
      "role = \"station\"\nclass = \"c\"\nname = \"s1\"\nstation_id = \"018f3c1e-0000-7000-8000-000000000001\"\n"
      "authority = \"ca.crt\"\ncertificate = \"a.crt\"\nkey = \"a.key\"\n",
      file));
  EXPECT_EQ(memberText(parseMember(good, file)), good);
  const auto message_with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    text.replace(text.find(from), from.size(), to);
    return support::thrownMessage([&] { parseMember(text, file); });
  };
  EXPECT_NE(message_with("port = 8883", "port = 0").find("port"), std::string::npos);
  EXPECT_NE(message_with("port = 8883", "prot = 8883").find("did you mean 'port'"), std::string::npos);
  EXPECT_NE(message_with("\"s1\"", "\"instructor\"").find("name"), std::string::npos);
  EXPECT_NE(message_with("key = \"a.key\"", "").find("key is missing"), std::string::npos);
}

TEST(ClassFolderTest, AClassHasASecretThatItsStationsKnow) {
  const TemporaryFolder temporary;
  const ClassFolder made = makeClassFolder(temporary / "class", aPlan(1));
  EXPECT_EQ(made.trainee_key.size(), 64u);
  const ClassFolder read = readClassFolder(made.folder);
  EXPECT_EQ(read.trainee_key, made.trainee_key);
  EXPECT_EQ(readMember(read.station("s01")).trainee_key, made.trainee_key);
  EXPECT_EQ(readMember(read.station(addStation(read))).trainee_key, made.trainee_key);
  EXPECT_EQ(readMember(read.instructor()).trainee_key, "");
  const ClassFolder other = makeClassFolder(temporary / "other", aPlan(1));
  EXPECT_NE(other.trainee_key, made.trainee_key);
  writeFile(made.folder / kTraineeKeyFile, "no key\n");
  EXPECT_THROW(readClassFolder(made.folder), Error);
}

TEST(ClassFolderTest, AnOlderClassWithoutASecretStaysWithoutOne) {
  const TemporaryFolder temporary;
  const ClassFolder made = makeClassFolder(temporary / "class", aPlan(1));
  std::filesystem::remove(made.folder / kTraineeKeyFile);
  std::filesystem::remove(made.station("s01") / kTraineeKeyFile);
  std::filesystem::remove_all(made.checker());
  const ClassFolder old = readClassFolder(made.folder);
  EXPECT_EQ(old.trainee_key, "");
  renewCertificates(old);
  EXPECT_FALSE(std::filesystem::exists(made.folder / kTraineeKeyFile)) << "every pseudonym would be another";
  EXPECT_EQ(readMember(old.station("s01")).trainee_key, "");
  EXPECT_EQ(readMember(old.checker()).role, Role::checker) << "what it lacks is made";
}

TEST(ClassFolderTest, RenewsEveryCertificateAndWarnsSixtyDaysBefore) {
  const TemporaryFolder temporary;
  const ClassFolder made = makeClassFolder(temporary / "class", aPlan(2));
  EXPECT_TRUE(certificateWarnings(certificateLives(made)).empty());
  EXPECT_EQ(renewCertificates(made, {}, kWarnDays - 1).size(), 6u);  // broker, instructor, collector, checker, two
  const auto lives = certificateLives(made);
  EXPECT_EQ(lives.size(), 7u);
  EXPECT_EQ(certificateWarnings(lives).size(), 6u) << "all but the authority";
  EXPECT_NE(certificateWarnings(lives).front().find("the broker ends in 5"), std::string::npos);
  const std::vector<std::string> hosts = certificateHosts(support::contentOf(made.broker() / "server.crt"));
  EXPECT_EQ(hosts, (std::vector<std::string>{"teacher.local", "192.168.1.10", "localhost", "127.0.0.1"}));
  EXPECT_EQ(renewCertificates(made, {"s02"}).size(), 1u);
  EXPECT_EQ(certificateWarnings(certificateLives(made)).size(), 5u);
  EXPECT_EQ(modeOf(made.station("s02") / "station.key"), 0600U);
  EXPECT_THROW(renewCertificates(made, {"s09"}), Error);
  EXPECT_EQ(
      support::runProgram("openssl", "verify -CAfile authority/ca.crt stations/s02/station.crt", made.folder).exit_code,
      0);
}

TEST(ClassFolderTest, SaysWhatAnOlderConfigurationOfTheBrokerLacks) {
  const TemporaryFolder temporary;
  const ClassFolder made = makeClassFolder(temporary / "class", aPlan(1));
  EXPECT_EQ(outdatedConfiguration(made), "");
  std::string text = support::contentOf(made.configuration());
  const std::string line = "use_username_as_clientid true\n";
  text.erase(text.find(line), line.size());
  writeFile(made.configuration(), text);
  EXPECT_EQ(outdatedConfiguration(made), "lacks use_username_as_clientid");
  writeBrokerConfiguration(made);
  writeFile(made.broker() / "access.acl", "");
  EXPECT_EQ(outdatedConfiguration(made), "has another access list");
}

TEST(ClassFolderTest, AKeyThatOthersMayReadIsSeen) {
  const TemporaryFolder temporary;
  const ClassFolder made = makeClassFolder(temporary / "class", aPlan(1));
  const auto key = made.station("s01") / "station.key";
  EXPECT_EQ(keyFileFault(key), "");
  for (const mode_t mode : {0644U, 0640U, 0604U}) {
    ASSERT_EQ(chmod(key.c_str(), mode), 0);
    EXPECT_NE(keyFileFault(key).find("chmod 600"), std::string::npos) << keyFileFault(key);
  }
}

}  // namespace
}  // namespace palpate::classroom
