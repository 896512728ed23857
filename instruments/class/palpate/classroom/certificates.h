// The certificates of a class: its own authority, the broker's, and one per member. Made here, so that a class depends
// on no one else's, and worthless outside.
//
// Keys are EC P-256; certificates X.509 version 3, signed with SHA-256.
#pragma once

#include <string>
#include <vector>

namespace palpate::classroom {

/// Texts (PEM).
struct Certified {
  std::string certificate;
  std::string key;
};

/// Ten years: longer than a class lasts, for it can sign new members as long.
inline constexpr int kAuthorityDays = 3650;
/// Two years: a year's class and its repetition; `palpate class renew` makes new ones.
inline constexpr int kMemberDays = 730;
/// So long before a certificate ends people are warned.
inline constexpr int kWarnDays = 60;

/// Makes the authority that signs the others. Throws Error, as all of these.
Certified makeAuthority(const std::string& name);
/// Makes the certificate of a broker that is reached under these names and addresses.
Certified makeServerCertificate(const Certified& authority, const std::vector<std::string>& hosts,
                                int days = kMemberDays);
/// Makes the certificate of a client; `name` is what the broker's access list knows it by.
Certified makeMemberCertificate(const Certified& authority, const std::string& name, int days = kMemberDays);
/// The names and addresses of a broker's certificate, in order.
std::vector<std::string> certificateHosts(const std::string& certificate);

/// The certificates that a broker must refuse, as of now and for as long as the authority lasts (PEM). A new list
/// replaces the one before.
std::string makeRevocationList(const Certified& authority, const std::vector<std::string>& certificates);

/// Days until it expires; negative once it has.
int daysLeft(const std::string& certificate);

}  // namespace palpate::classroom
