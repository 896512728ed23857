// The container of a WebM film: compressed pictures with their moments -> bytes with length, index and colour space,
// so that every player knows how long it is and can jump. Own, because Debian 12 packages the headers of libwebm's
// reader only. https://www.webmproject.org/docs/container, RFC 8794, RFC 9559. Pure.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "palpate/view/image.h"

namespace palpate::film {

class WebmContainer {
 public:
  /// One compressed picture; moments in ms, never falling. The first is a key picture.
  void add(std::string_view compressed, std::int64_t at_ms, bool is_key);
  std::size_t bytes() const { return bytes_; }

  /// The head before the clusters and the clusters themselves, in order; each piece may be written by itself.
  std::vector<std::string> pieces(const view::ImageSize& size, std::int64_t length_ms) const;

 private:
  struct Cluster {
    std::int64_t begin_ms;
    std::string blocks;
  };
  std::vector<Cluster> clusters_;
  std::size_t bytes_ = 0;
};

}  // namespace palpate::film
