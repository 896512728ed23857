// The file:
//   "PALPLOCK"  version (4)  bytes in a piece (4)  nonce of the file (8)  length of the key's name (4)  the name
//   pieces: sealed bytes, 16 bytes of seal; all full but the last, which may be empty
// Numbers are little-endian. A piece's nonce is the file's and its number; what is sealed with it, unencrypted, is the
// whole header and whether it is the last.
#include "palpate/training/records/locked_file.h"
#include "palpate/base/system/process.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <algorithm>
#include <memory>
#include <string_view>

#include "palpate/base/byte_file.h"
#include "palpate/base/error.h"
#include "palpate/base/output_file.h"

namespace palpate::training {

namespace {

constexpr std::string_view kLockMagic = "PALPLOCK";
constexpr std::uint32_t kLockVersion = 1;
constexpr std::uint32_t kPieceBytes = 1u << 18;
constexpr std::uint32_t kLargestPiece = 1u << 24;  // limits the memory that a stranger's file can claim
constexpr std::size_t kSealBytes = 16;
constexpr std::size_t kFixedHeader = 28;
constexpr std::uint32_t kLongestKeyRef = 64;

void appendNumber(std::string& to, std::uint32_t number) {
  for (unsigned shift = 0; shift < 32; shift += 8) to += static_cast<char>((number >> shift) & 0xffu);
}

std::uint32_t numberAt(std::string_view bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (unsigned i = 0; i < 4; ++i)
    number |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * i);
  return number;
}

struct LockHeader {
  std::string bytes;  ///< all of it
  std::string nonce;
  std::string key_ref;
  std::uint32_t piece = kPieceBytes;
};

LockHeader newHeader(const std::string& key_ref) {
  if (key_ref.size() > kLongestKeyRef) throw Error("the name of a key is too long");
  LockHeader header;
  header.key_ref = key_ref;
  header.nonce.resize(8);
  if (!system::fillWithRandom({reinterpret_cast<unsigned char*>(header.nonce.data()), header.nonce.size()}))
    throw Error("the system provides no random numbers");
  header.bytes = kLockMagic;
  appendNumber(header.bytes, kLockVersion);
  appendNumber(header.bytes, header.piece);
  header.bytes += header.nonce;
  appendNumber(header.bytes, static_cast<std::uint32_t>(key_ref.size()));
  header.bytes += key_ref;
  return header;
}

/// Nothing where the file begins otherwise.
std::optional<LockHeader> readLockHeader(ByteFile& file) {
  LockHeader header;
  if (!file.isOpen() || !file.read(0, kFixedHeader, header.bytes) || !header.bytes.starts_with(kLockMagic)) {
    return std::nullopt;
  }
  const std::uint32_t name = numberAt(header.bytes, 24);
  if (numberAt(header.bytes, 8) != kLockVersion || name > kLongestKeyRef) return std::nullopt;
  header.piece = numberAt(header.bytes, 12);
  if (header.piece == 0 || header.piece > kLargestPiece) return std::nullopt;
  header.nonce = header.bytes.substr(16, 8);
  if (!file.read(kFixedHeader, name, header.key_ref)) return std::nullopt;
  header.bytes += header.key_ref;
  return header;
}

const unsigned char* bytesOf(std::string_view text) { return reinterpret_cast<const unsigned char*>(text.data()); }
unsigned char* bytesOf(std::string& text) { return reinterpret_cast<unsigned char*>(text.data()); }

/// Seals pieces, or opens them.
class PieceCipher {
 public:
  PieceCipher(const TraineeKey& key, const LockHeader& header)
      : context_(::EVP_CIPHER_CTX_new(), &::EVP_CIPHER_CTX_free), key_(key), header_(header) {
    if (context_ == nullptr) throw Error("OpenSSL has no AES-256-GCM");
  }

  std::string seal(std::string_view plain, std::uint32_t number, bool last) {
    std::string sealed(plain.size() + kSealBytes, '\0');
    begin(number, last, true);
    int written = 0;
    check(::EVP_EncryptUpdate(context_.get(), bytesOf(sealed), &written, bytesOf(plain), intSize(plain)));
    check(::EVP_EncryptFinal_ex(context_.get(), bytesOf(sealed) + written, &written));
    check(::EVP_CIPHER_CTX_ctrl(context_.get(), EVP_CTRL_GCM_GET_TAG, kSealBytes, bytesOf(sealed) + plain.size()));
    return sealed;
  }

  /// Nothing where the seal is broken.
  std::optional<std::string> open(std::string_view sealed, std::uint32_t number, bool last) {
    const std::string_view inside = sealed.substr(0, sealed.size() - kSealBytes);
    std::string seal(sealed.substr(inside.size()));
    std::string plain(inside.size(), '\0');
    begin(number, last, false);
    int written = 0;
    check(::EVP_DecryptUpdate(context_.get(), bytesOf(plain), &written, bytesOf(inside), intSize(inside)));
    check(::EVP_CIPHER_CTX_ctrl(context_.get(), EVP_CTRL_GCM_SET_TAG, kSealBytes, seal.data()));
    if (::EVP_DecryptFinal_ex(context_.get(), bytesOf(plain) + written, &written) != 1) return std::nullopt;
    return plain;
  }

 private:
  static void check(int done) {
    if (done != 1) throw Error("AES failed in OpenSSL");
  }
  static int intSize(std::string_view bytes) { return static_cast<int>(bytes.size()); }

  void begin(std::uint32_t number, bool last, bool encrypt) {
    std::string nonce = header_.nonce;
    appendNumber(nonce, number);
    check(::EVP_CipherInit_ex(context_.get(), ::EVP_aes_256_gcm(), nullptr, key_.data(), bytesOf(nonce),
                              encrypt ? 1 : 0));
    const std::string known = header_.bytes + (last ? 'L' : '-');
    int ignored = 0;
    check(::EVP_CipherUpdate(context_.get(), nullptr, &ignored, bytesOf(std::string_view(known)), intSize(known)));
  }

  std::unique_ptr<EVP_CIPHER_CTX, decltype(&::EVP_CIPHER_CTX_free)> context_;
  const TraineeKey& key_;
  const LockHeader& header_;
};

}  // namespace

TraineeKey newTraineeKey() {
  TraineeKey key{};
  if (!system::fillWithRandom(key)) throw Error("the system provides no random numbers");
  return key;
}

void lockFile(const std::filesystem::path& in, const std::filesystem::path& out, const TraineeKey& key,
              const std::string& key_ref) {
  ByteFile plain(in);
  if (!plain.isOpen()) throw Error::inFile(in.string(), "cannot be read");
  const LockHeader header = newHeader(key_ref);
  PieceCipher cipher(key, header);
  OutputFile file(out, OutputFile::Unfinished::remove, OutputFile::Access::owner_only);
  file.write(header.bytes);
  std::string piece;
  std::uint64_t at = 0;
  for (std::uint32_t number = 0;; ++number) {
    const std::uint64_t size = std::min<std::uint64_t>(header.piece, plain.size() - at);
    if (!plain.read(at, size, piece)) throw Error::inFile(in.string(), "cannot be read to its end");
    at += size;
    const bool last = at == plain.size();
    file.write(cipher.seal(piece, number, last));
    if (last) break;
  }
  file.commit();
}

void unlockFile(const std::filesystem::path& in, const std::filesystem::path& out, const TraineeKey& key) {
  ByteFile sealed(in);
  const auto header = readLockHeader(sealed);
  if (!header) throw Error::inFile(in.string(), "is not a locked recording");
  PieceCipher cipher(key, *header);
  OutputFile file(out, OutputFile::Unfinished::remove, OutputFile::Access::owner_only);
  std::string piece;
  std::uint64_t at = header->bytes.size();
  for (std::uint32_t number = 0;; ++number) {
    const std::uint64_t size = std::min<std::uint64_t>(header->piece + kSealBytes, sealed.size() - at);
    if (size < kSealBytes || !sealed.read(at, size, piece)) {
      throw Error::inFile(in.string(), "is cut off: its end is missing");
    }
    at += size;
    const bool last = at == sealed.size();
    const auto plain = cipher.open(piece, number, last);
    if (!plain) {
      throw Error::inFile(in.string(), "cannot be opened: it is locked with another key, was changed, or is cut off");
    }
    file.write(*plain);
    if (last) break;
  }
  file.commit();
}

std::optional<std::string> lockedWith(const std::filesystem::path& file) {
  ByteFile bytes(file);
  const auto header = readLockHeader(bytes);
  return header ? std::optional(header->key_ref) : std::nullopt;
}

}  // namespace palpate::training
