#include "cli/serve/wire.h"

#include <fmt/format.h>
#include <openssl/ssl.h>

#include <string>

#include "palpate/base/error.h"
#include "palpate/base/private_folder.h"

namespace palpate::app::serving {

namespace {

using TlsStatus = boost::system::error_code;

}  // namespace

std::shared_ptr<TlsContext> tlsFrom(const std::filesystem::path& certificate, const std::filesystem::path& key) {
  auto context = std::make_shared<TlsContext>(TlsContext::tls_server);
  SSL_CTX_set_min_proto_version(context->native_handle(), TLS1_2_VERSION);
  SSL_CTX_set_options(context->native_handle(), SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION);
  TlsStatus status;
  context->use_certificate_chain_file(certificate.string(), status);
  if (status) throw Error::inFile(certificate.string(), "must be a certificate (PEM): " + status.message());
  requireClosedFile(key, OtherReaders::group);  // keys often belong to one (Debian's ssl-cert)
  context->use_private_key_file(key.string(), TlsContext::pem, status);
  if (status || SSL_CTX_check_private_key(context->native_handle()) != 1) {
    throw Error::inFile(key.string(), fmt::format("must be the private key of {} (PEM, without a password){}",
                                                  certificate.string(), status ? ": " + status.message() : ""));
  }
  return context;
}

}  // namespace palpate::app::serving
