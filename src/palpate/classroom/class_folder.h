// The folder of a class: its certificates, the broker's configuration and access list, and a folder for each who takes
// part, to be carried to that computer.
//
//   DIR/class.toml                     what the class is called, where its broker is
//   DIR/authority/ca.crt, ca.key       signs the others; the key never leaves this computer
//   DIR/broker/                        mosquitto.conf, access.acl, ca.crt, server.crt, server.key
//   DIR/instructor/, DIR/ingest/       instructor.toml, ingest.toml, with certificate and key
//   DIR/stations/s01/ ...              station.toml, with certificate and key
//   DIR/revoked/s01-1/ ...             of stations that were removed, without the key; DIR/broker/revoked.crl names
//   them
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "palpate/classroom/class_settings.h"

namespace palpate::classroom {

struct ClassPlan {
  std::string class_id;
  std::string label;  ///< for people; may be empty
  int stations = 1;
  std::vector<std::string> hosts = {"localhost"};  ///< names and addresses of the broker; stations use the first
  int port = kStandardPort;
  Retention retention;
};

struct ClassFolder {
  std::filesystem::path folder;
  std::string class_id;
  std::string label;
  std::string host;
  int port = kStandardPort;
  Retention retention;
  std::vector<std::string> stations;  ///< names, in order

  std::filesystem::path broker() const { return folder / "broker"; }
  std::filesystem::path configuration() const { return broker() / "mosquitto.conf"; }
  std::filesystem::path revocationList() const { return broker() / "revoked.crl"; }
  std::filesystem::path instructor() const { return folder / "instructor"; }
  std::filesystem::path ingest() const { return folder / "ingest"; }
  std::filesystem::path station(const std::string& name) const { return folder / "stations" / name; }
};

/// Throws Error for names that make no sense and where a class is already; what was there stays as it is.
ClassFolder makeClassFolder(const std::filesystem::path& folder, const ClassPlan& plan);
/// Throws Error for what is no such folder.
ClassFolder readClassFolder(const std::filesystem::path& folder);

/// One more station: the next number, or this name. Throws Error where it is already. The broker need not be told.
std::string addStation(const ClassFolder& folder, const std::string& name = {});

/// Its certificate is revoked: a broker that is started from now on lets it in no longer, whoever has its folder. Its
/// rows stay, and the name may be added again. Throws Error where there is no such station.
void removeStation(const ClassFolder& folder, const std::string& name);

/// The broker's configuration for where the folder lies now, written again: paths in it are absolute.
void writeBrokerConfiguration(const ClassFolder& folder);
std::string accessList(const std::string& class_id);

/// What certificates of roles are named. The plus sign keeps the broker from ever matching them with the patterns for
/// stations.
std::string roleCertificateName(Role role);

/// Private: the owner alone may read it.
void writeKeyFile(const std::filesystem::path& file, const std::string& text);

}  // namespace palpate::classroom
