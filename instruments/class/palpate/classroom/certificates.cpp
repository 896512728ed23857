#include "palpate/classroom/certificates.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <openssl/bio.h>
#include <openssl/bn.h>
#include <openssl/err.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>

#include <array>
#include <memory>

#include "palpate/base/error.h"

namespace palpate::classroom {

namespace {

template <auto release>
struct Releases {
  template <class T>
  void operator()(T* pointer) const {
    release(pointer);
  }
};
using KeyHandle = std::unique_ptr<EVP_PKEY, Releases<EVP_PKEY_free>>;
using CertificateHandle = std::unique_ptr<X509, Releases<X509_free>>;
using BioHandle = std::unique_ptr<BIO, Releases<BIO_free_all>>;
using NumberHandle = std::unique_ptr<BIGNUM, Releases<BN_free>>;
using ListHandle = std::unique_ptr<X509_CRL, Releases<X509_CRL_free>>;
using RevokedHandle = std::unique_ptr<X509_REVOKED, Releases<X509_REVOKED_free>>;
using TimeHandle = std::unique_ptr<ASN1_TIME, Releases<ASN1_TIME_free>>;
using AltNamesHandle = std::unique_ptr<GENERAL_NAMES, Releases<GENERAL_NAMES_free>>;
using ExtensionHandle = std::unique_ptr<X509_EXTENSION, Releases<X509_EXTENSION_free>>;

[[noreturn]] void refuseCertificate(const char* what) {
  std::array<char, 256> reason{};
  ERR_error_string_n(ERR_get_error(), reason.data(), reason.size());
  throw Error(fmt::format("certificate: {} failed: {}", what, reason.data()));
}
void requireSuccess(bool done, const char* what) {
  if (!done) refuseCertificate(what);
}

std::string textIn(BIO* bio) {
  char* bytes = nullptr;
  const long size = BIO_get_mem_data(bio, &bytes);
  return {bytes, static_cast<std::size_t>(size)};
}
std::string toPem(X509* certificate) {
  const BioHandle bio(BIO_new(BIO_s_mem()));
  requireSuccess(bio && PEM_write_bio_X509(bio.get(), certificate) == 1, "writing it");
  return textIn(bio.get());
}
std::string toPem(EVP_PKEY* key) {
  const BioHandle bio(BIO_new(BIO_s_mem()));
  requireSuccess(bio && PEM_write_bio_PrivateKey(bio.get(), key, nullptr, nullptr, 0, nullptr, nullptr) == 1,
                 "writing its key");
  return textIn(bio.get());
}
CertificateHandle certificateFrom(const std::string& pem) {
  const BioHandle bio(BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())));
  CertificateHandle certificate(PEM_read_bio_X509(bio.get(), nullptr, nullptr, nullptr));
  requireSuccess(certificate != nullptr, "reading it");
  return certificate;
}
KeyHandle keyFrom(const std::string& pem) {
  const BioHandle bio(BIO_new_mem_buf(pem.data(), static_cast<int>(pem.size())));
  KeyHandle key(PEM_read_bio_PrivateKey(bio.get(), nullptr, nullptr, nullptr));
  requireSuccess(key != nullptr, "reading its key");
  return key;
}

constexpr long kDayS = 86400;

TimeHandle timeIn(int days) {
  TimeHandle time(X509_gmtime_adj(nullptr, days * kDayS));
  requireSuccess(time != nullptr, "dating it");
  return time;
}

/// A certificate that is being made.
class Draft {
 public:
  Draft(const std::string& name, int days) : key_(EVP_EC_gen("P-256")), certificate_(X509_new()) {
    requireSuccess(key_ && certificate_, "making its key");
    X509* x = certificate_.get();
    X509_set_version(x, X509_VERSION_3);
    const NumberHandle serial(BN_new());
    constexpr int kSerialBits = 127;  // positive, and never the same twice
    requireSuccess(serial && BN_rand(serial.get(), kSerialBits, BN_RAND_TOP_ONE, BN_RAND_BOTTOM_ANY) == 1 &&
                       BN_to_ASN1_INTEGER(serial.get(), X509_get_serialNumber(x)) != nullptr,
                   "drawing its number");
    X509_gmtime_adj(X509_getm_notBefore(x), -kDayS);  // clocks of a class differ
    X509_gmtime_adj(X509_getm_notAfter(x), days * kDayS);
    X509_set_pubkey(x, key_.get());
    requireSuccess(X509_NAME_add_entry_by_txt(X509_get_subject_name(x), "CN", MBSTRING_UTF8,
                                              reinterpret_cast<const unsigned char*>(name.data()),
                                              static_cast<int>(name.size()), -1, 0) == 1,
                   "naming it");
  }

  void extend(int kind, const std::string& value, X509* issuer) {
    X509V3_CTX context;
    X509V3_set_ctx(&context, issuer == nullptr ? certificate_.get() : issuer, certificate_.get(), nullptr, nullptr, 0);
    const ExtensionHandle extension(X509V3_EXT_conf_nid(nullptr, &context, kind, value.c_str()));
    requireSuccess(extension && X509_add_ext(certificate_.get(), extension.get(), -1) == 1, "extending it");
  }

  /// Self-signed without an issuer.
  Certified signedBy(X509* issuer, EVP_PKEY* issuer_key) {
    X509* x = certificate_.get();
    X509_set_issuer_name(x, X509_get_subject_name(issuer == nullptr ? x : issuer));
    requireSuccess(X509_sign(x, issuer_key == nullptr ? key_.get() : issuer_key, EVP_sha256()) > 0, "signing it");
    return {toPem(x), toPem(key_.get())};
  }

 private:
  KeyHandle key_;
  CertificateHandle certificate_;
};

Certified issued(const Certified& authority, const std::string& name, const char* usage, const std::string& hosts,
                 int days) {
  const CertificateHandle issuer = certificateFrom(authority.certificate);
  const KeyHandle issuer_key = keyFrom(authority.key);
  Draft draft(name, days);
  draft.extend(NID_basic_constraints, "critical,CA:FALSE", issuer.get());
  draft.extend(NID_key_usage, "critical,digitalSignature", issuer.get());
  draft.extend(NID_ext_key_usage, usage, issuer.get());
  draft.extend(NID_authority_key_identifier, "keyid", issuer.get());
  if (!hosts.empty()) draft.extend(NID_subject_alt_name, hosts, issuer.get());
  return draft.signedBy(issuer.get(), issuer_key.get());
}

bool isAddress(const std::string& host) {
  std::array<unsigned char, 16> bytes{};
  return inet_pton(AF_INET, host.c_str(), bytes.data()) == 1 || inet_pton(AF_INET6, host.c_str(), bytes.data()) == 1;
}

}  // namespace

Certified makeAuthority(const std::string& name) {
  Draft draft(name, kAuthorityDays);
  draft.extend(NID_basic_constraints, "critical,CA:TRUE,pathlen:0", nullptr);
  draft.extend(NID_key_usage, "critical,keyCertSign,cRLSign", nullptr);
  draft.extend(NID_subject_key_identifier, "hash", nullptr);
  return draft.signedBy(nullptr, nullptr);
}

Certified makeServerCertificate(const Certified& authority, const std::vector<std::string>& hosts, int days) {
  std::string names;
  for (const std::string& host : hosts) {
    names += fmt::format("{}{}:{}", names.empty() ? "" : ",", isAddress(host) ? "IP" : "DNS", host);
  }
  return issued(authority, hosts.empty() ? "broker" : hosts.front(), "serverAuth", names, days);
}

Certified makeMemberCertificate(const Certified& authority, const std::string& name, int days) {
  return issued(authority, name, "clientAuth", {}, days);
}

std::vector<std::string> certificateHosts(const std::string& certificate) {
  const CertificateHandle read = certificateFrom(certificate);
  const AltNamesHandle names(
      static_cast<GENERAL_NAMES*>(X509_get_ext_d2i(read.get(), NID_subject_alt_name, nullptr, nullptr)));
  std::vector<std::string> hosts;
  for (int i = 0; names && i < sk_GENERAL_NAME_num(names.get()); ++i) {
    const GENERAL_NAME* name = sk_GENERAL_NAME_value(names.get(), i);
    const ASN1_STRING* const text = name->type == GEN_DNS ? name->d.dNSName : name->d.iPAddress;
    if (name->type == GEN_DNS) {
      hosts.emplace_back(reinterpret_cast<const char*>(ASN1_STRING_get0_data(text)),
                         static_cast<std::size_t>(ASN1_STRING_length(text)));
    } else if (name->type == GEN_IPADD) {
      std::array<char, INET6_ADDRSTRLEN> words{};
      const int family = ASN1_STRING_length(text) == 4 ? AF_INET : AF_INET6;
      if (inet_ntop(family, ASN1_STRING_get0_data(text), words.data(), words.size()) != nullptr) {
        hosts.emplace_back(words.data());
      }
    }
  }
  return hosts;
}

std::string makeRevocationList(const Certified& authority, const std::vector<std::string>& certificates) {
  const CertificateHandle issuer = certificateFrom(authority.certificate);
  const ListHandle list(X509_CRL_new());
  requireSuccess(list && X509_CRL_set_version(list.get(), X509_CRL_VERSION_2) == 1 &&
                     X509_CRL_set_issuer_name(list.get(), X509_get_subject_name(issuer.get())) == 1 &&
                     X509_CRL_set1_lastUpdate(list.get(), timeIn(-1).get()) == 1 &&  // clocks of a class differ
                     X509_CRL_set1_nextUpdate(list.get(), timeIn(kAuthorityDays).get()) == 1,
                 "listing what is revoked");
  for (const std::string& certificate : certificates) {
    RevokedHandle revoked(X509_REVOKED_new());
    requireSuccess(revoked &&
                       X509_REVOKED_set_serialNumber(revoked.get(),
                                                     X509_get_serialNumber(certificateFrom(certificate).get())) == 1 &&
                       X509_REVOKED_set_revocationDate(revoked.get(), timeIn(0).get()) == 1 &&
                       X509_CRL_add0_revoked(list.get(), revoked.get()) == 1,
                   "revoking it");
    static_cast<void>(revoked.release());  // the list's now
  }
  const KeyHandle issuer_key = keyFrom(authority.key);
  const BioHandle bio(BIO_new(BIO_s_mem()));
  requireSuccess(X509_CRL_sort(list.get()) == 1 && X509_CRL_sign(list.get(), issuer_key.get(), EVP_sha256()) > 0 &&
                     bio && PEM_write_bio_X509_CRL(bio.get(), list.get()) == 1,
                 "signing the list");
  return textIn(bio.get());
}

int daysLeft(const std::string& certificate) {
  int days = 0;
  int seconds = 0;
  requireSuccess(ASN1_TIME_diff(&days, &seconds, nullptr, X509_get0_notAfter(certificateFrom(certificate).get())) == 1,
                 "reading its time");
  return seconds < 0 ? days - 1 : days;
}

}  // namespace palpate::classroom
