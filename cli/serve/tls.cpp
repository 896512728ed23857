#include "cli/serve/wire.h"

#include <fmt/format.h>
#include <openssl/ssl.h>
#include <sys/stat.h>

#include <cerrno>
#include <string>
#include <system_error>

#include "palpate/base/error.h"

namespace palpate::app::serving {

namespace {

using TlsStatus = boost::system::error_code;

/// Others than owner and group may read it: certificates' keys often belong to a group (Debian's ssl-cert).
constexpr unsigned kOthers = 0007;

void checkMode(const std::filesystem::path& file) {
  struct stat facts = {};
  if (::stat(file.c_str(), &facts) != 0) {
    throw Error::inFile(file.string(), std::generic_category().message(errno));
  }
  if ((facts.st_mode & kOthers) != 0) {
    throw Error::inFile(file.string(), "others may read or write it: chmod 600 " + file.string());
  }
}

}  // namespace

std::shared_ptr<TlsContext> tlsFrom(const std::filesystem::path& certificate, const std::filesystem::path& key) {
  auto context = std::make_shared<TlsContext>(TlsContext::tls_server);
  SSL_CTX_set_min_proto_version(context->native_handle(), TLS1_2_VERSION);
  SSL_CTX_set_options(context->native_handle(), SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION);
  TlsStatus status;
  context->use_certificate_chain_file(certificate.string(), status);
  if (status) throw Error::inFile(certificate.string(), "must be a certificate, PEM: " + status.message());
  checkMode(key);
  context->use_private_key_file(key.string(), TlsContext::pem, status);
  if (status || SSL_CTX_check_private_key(context->native_handle()) != 1) {
    throw Error::inFile(key.string(), fmt::format("must be the key of {}, PEM, without a password{}",
                                                  certificate.string(), status ? ": " + status.message() : ""));
  }
  return context;
}

}  // namespace palpate::app::serving
