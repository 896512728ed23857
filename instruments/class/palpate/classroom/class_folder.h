// The folder of a class: its certificates, the broker's configuration and access list, and a folder for each who takes
// part, to be carried to that computer.
//
//   DIR/class.toml                     the class's name and its broker's address
//   DIR/authority/ca.crt, ca.key       signs the others; the key never leaves this computer
//   DIR/broker/                        mosquitto.conf, access.acl, ca.crt, server.crt, server.key
//   DIR/trainees.key                   the class's secret, from which trainees' pseudonyms are made
//   DIR/instructor/, DIR/ingest/       instructor.toml, ingest.toml, with certificate and key
//   DIR/instructor-2/ ...              for further windows: a certificate is one connection
//   DIR/checker/                       checker.toml, for `palpate class check`
//   DIR/stations/s01/ ...              station.toml, with certificate and key
//   DIR/revoked/s01-1/ ...             of stations that were removed, without the key; DIR/broker/revoked.crl names
//   them
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "palpate/classroom/certificates.h"
#include "palpate/classroom/class_settings.h"
#include "palpate/classroom/row_keeper.h"

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
  std::int64_t station_megabytes = kStationBytes >> 20;  ///< a station's share of the disk, since the last purge
  std::string trainee_key;                               ///< empty: the class is older than this key
  std::vector<std::string> stations;                     ///< names, in order

  std::filesystem::path broker() const { return folder / "broker"; }
  std::filesystem::path configuration() const { return broker() / "mosquitto.conf"; }
  std::filesystem::path revocationList() const { return broker() / "revoked.crl"; }
  /// The number-th window, from 1.
  std::filesystem::path instructor(int number = 1) const;
  std::filesystem::path ingest() const { return folder / "ingest"; }
  std::filesystem::path checker() const { return folder / "checker"; }
  std::filesystem::path station(const std::string& name) const { return folder / "stations" / name; }
};

/// Throws Error for names that make no sense and where a class is already; existing files stay unchanged.
ClassFolder makeClassFolder(const std::filesystem::path& folder, const ClassPlan& plan);
/// Throws Error if `folder` is not a class folder.
ClassFolder readClassFolder(const std::filesystem::path& folder);

/// Adds a station: the next number, or this name. Throws Error if it exists. The broker needs no restart.
std::string addStation(const ClassFolder& folder, const std::string& name = {});

/// Revokes its certificate: a broker started from now on refuses it, even from a copy of its folder. Its rows stay, and
/// the name may be added again. Throws Error for an unknown station.
void removeStation(const ClassFolder& folder, const std::string& name);

/// The broker's configuration for where the folder lies now, written again: paths in it are absolute.
void writeBrokerConfiguration(const ClassFolder& folder);
std::string accessList(const std::string& class_id);

/// Describes how the stored configuration differs from what would be written now; empty: not at all.
std::string outdatedConfiguration(const ClassFolder& folder);

/// The name of a role's certificate. The plus sign keeps the broker from ever matching them with the patterns for
/// stations. `number`: of an instructor's window.
std::string roleCertificateName(Role role, int number = 1);

/// Windows of a class at once; the broker knows of all of them from the beginning.
inline constexpr int kMaxInstructors = 9;
/// Adds a window, returns its folder; the broker needs no restart. Throws Error where there are kMaxInstructors.
std::filesystem::path addInstructor(const ClassFolder& folder);

/// New certificates and keys for these ("broker", "instructor", "instructor-2", "ingest", "checker", stations); empty:
/// for all, and those that an older class lacks. Older ones stay valid to their end. Returns the folders, whose
/// contents must be carried to where they are used. Throws Error for a name that is not there.
std::vector<std::filesystem::path> renewCertificates(const ClassFolder& folder,
                                                     const std::vector<std::string>& names = {},
                                                     int days = kMemberDays);

/// A certificate of a class and when it ends.
struct CertificateLife {
  std::string whose;  ///< "the broker", "s01"
  std::filesystem::path file;
  int days_left = 0;  ///< negative: it has ended
};
/// Lives of all certificates, including the authority's. Throws Error for one that cannot be read.
std::vector<CertificateLife> certificateLives(const ClassFolder& folder);
/// One line for each that ends within kWarnDays.
std::vector<std::string> certificateWarnings(const std::vector<CertificateLife>& lives);

/// Empty: the file is its owner's alone; else the fault and its remedy.
std::string keyFileFault(const std::filesystem::path& file);

/// Private: the owner alone may read it.
void writeKeyFile(const std::filesystem::path& file, const std::string& text);

}  // namespace palpate::classroom
