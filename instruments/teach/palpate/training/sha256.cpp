// Over OpenSSL's digests.
#include "palpate/training/sha256.h"

#include <openssl/evp.h>
#include <openssl/hmac.h>

#include <algorithm>
#include <memory>

#include "palpate/base/byte_file.h"
#include "palpate/base/error.h"
#include "palpate/base/hmac_sha256.h"

namespace palpate::training {

namespace {

class RunningSha256 {
 public:
  RunningSha256() : context_(::EVP_MD_CTX_new(), &::EVP_MD_CTX_free) {
    check(context_ != nullptr && ::EVP_DigestInit_ex(context_.get(), ::EVP_sha256(), nullptr) == 1);
  }
  void add(std::string_view bytes) { check(::EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) == 1); }
  std::array<std::uint8_t, 32> end() {
    std::array<std::uint8_t, 32> digest{};
    check(::EVP_DigestFinal_ex(context_.get(), digest.data(), nullptr) == 1);
    return digest;
  }

 private:
  static void check(bool done) {
    if (!done) throw Error("OpenSSL does not provide SHA-256");
  }
  std::unique_ptr<EVP_MD_CTX, decltype(&::EVP_MD_CTX_free)> context_;
};

std::string hexText(const Sha256Digest& digest) {
  const std::array<char, 64> digits = hexOf(digest);
  return {digits.data(), digits.size()};
}

}  // namespace

std::array<std::uint8_t, 32> computeSha256(std::string_view bytes) {
  RunningSha256 running;
  running.add(bytes);
  return running.end();
}

std::array<std::uint8_t, 32> computeHmacSha256(std::string_view key, std::string_view bytes) {
  std::array<std::uint8_t, 32> digest{};
  if (::HMAC(::EVP_sha256(), key.data(), static_cast<int>(key.size()),
             reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), digest.data(), nullptr) == nullptr) {
    throw Error("OpenSSL does not provide HMAC");
  }
  return digest;
}

std::string sha256Hex(std::string_view bytes) { return hexText(computeSha256(bytes)); }

std::string sha256OfFile(const std::filesystem::path& file) {
  ByteFile bytes(file);
  if (!bytes.isOpen()) throw Error::inFile(file.string(), "cannot be read");
  RunningSha256 running;
  std::string piece;
  constexpr std::uint64_t kPiece = std::uint64_t{1} << 16;
  for (std::uint64_t at = 0; at < bytes.size(); at += kPiece) {
    if (!bytes.read(at, std::min(kPiece, bytes.size() - at), piece)) {
      throw Error::inFile(file.string(), "cannot be read to its end");
    }
    running.add(piece);
  }
  return hexText(running.end());
}

}  // namespace palpate::training
