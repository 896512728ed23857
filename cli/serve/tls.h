// A certificate and its key out of two files, for `palpate serve` over TLS.
#pragma once

#include <boost/asio/ssl/context.hpp>
#include <filesystem>
#include <memory>

namespace palpate::app::serving {

using TlsContext = boost::asio::ssl::context;

/// PEM: the certificate with those that it is signed by, and its key, which the group may read and others may not.
/// TLS 1.2 and 1.3. Throws Error: no such files, another form, a key of another certificate, or one that others may
/// read.
std::shared_ptr<TlsContext> tlsFrom(const std::filesystem::path& certificate, const std::filesystem::path& key);

}  // namespace palpate::app::serving
