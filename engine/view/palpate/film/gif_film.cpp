// An animated GIF through giflib. Each picture has a palette of its own, because a colour map may be switched on at any
// time, and holds only the rectangle that changed: a body at rest costs nothing.
#include <fmt/format.h>
#include <gif_lib.h>

#include <algorithm>
#include <array>
#include <utility>

#include "palpate/film/film.h"

namespace palpate::film {

namespace {

constexpr int kColours = 256;
constexpr std::int64_t kMsPerTick = 10;  ///< a GIF counts in hundredths of a second
constexpr int kMaxTicks = 65535;

struct Rectangle {
  int left = 0;
  int top = 0;
  int width = 0;
  int height = 0;
};

/// The rectangle that differs; one pixel where none does: a picture must have one.
Rectangle changedIn(const view::Image& before, const view::Image& now) {
  if (before.pixels.empty()) return {0, 0, now.width, now.height};
  int left = now.width;
  int right = -1;
  int top = now.height;
  int bottom = -1;
  for (int y = 0; y < now.height; ++y) {
    for (int x = 0; x < now.width; ++x) {
      if (before.at(x, y) == now.at(x, y)) continue;
      left = std::min(left, x);
      right = std::max(right, x);
      top = std::min(top, y);
      bottom = y;
    }
  }
  if (right < 0) return {0, 0, 1, 1};
  return {left, top, right - left + 1, bottom - top + 1};
}

/// Pixels of a rectangle as numbers of colours.
struct Painted {
  std::vector<GifByteType> pixels;
  std::array<GifColorType, kColours> palette{};
  int colours = kColours;
};

class GifFilm final : public Film {
 public:
  GifFilm(std::filesystem::path file, const FilmFormat& format) : Film(std::move(file), format) {
    int reason = 0;
    gif_ = EGifOpen(this, appendBytes, &reason);
    check(gif_ != nullptr);
    EGifSetGifVersion(gif_, true);
    check(EGifPutScreenDesc(gif_, format_.size.width, format_.size.height, 8, 0, nullptr) == GIF_OK);
    repeatForEver();
  }
  ~GifFilm() override {
    if (gif_ != nullptr) close();
  }

 protected:
  void compress(const view::Image& picture, const Shown& shown) override {
    const Rectangle changed = changedIn(before_, picture);
    const Painted painted = paint(picture, changed);
    showFor(shown);
    // A palette has a power of two colours.
    const int colours = 1 << std::max(1, GifBitSize(painted.colours));
    ColorMapObject* palette = GifMakeMapObject(colours, painted.palette.data());
    check(palette != nullptr);
    const int begun = EGifPutImageDesc(gif_, changed.left, changed.top, changed.width, changed.height, false, palette);
    GifFreeMapObject(palette);
    check(begun == GIF_OK);
    for (int y = 0; y < changed.height; ++y) {
      // giflib gets the row to write to, but masks it in place only.
      auto* row = const_cast<GifByteType*>(painted.pixels.data() + static_cast<std::ptrdiff_t>(y) * changed.width);
      check(EGifPutLine(gif_, row, changed.width) == GIF_OK);
    }
    flushBytes();
    before_ = picture;
  }

  void end() override {
    check(close() == GIF_OK);
    flushBytes();
  }

 private:
  static int appendBytes(GifFileType* gif, const GifByteType* bytes, int count) {
    auto& film = *static_cast<GifFilm*>(gif->UserData);
    film.bytes_.append(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(count));
    return count;
  }
  /// Called outside of giflib, which no exception may cross.
  void flushBytes() {
    output_.write(bytes_);
    bytes_.clear();
  }
  int close() {
    int reason = 0;
    return EGifCloseFile(std::exchange(gif_, nullptr), &reason);
  }
  void check(bool done) const {
    if (done) return;
    const char* words = gif_ != nullptr ? GifErrorString(gif_->Error) : nullptr;
    fail(fmt::format("giflib cannot write it: {}", words != nullptr ? words : "not enough memory"));
  }

  void repeatForEver() {
    constexpr std::array<GifByteType, 3> kForEver = {1, 0, 0};
    check(EGifPutExtensionLeader(gif_, APPLICATION_EXT_FUNC_CODE) == GIF_OK &&
          EGifPutExtensionBlock(gif_, 11, "NETSCAPE2.0") == GIF_OK &&
          EGifPutExtensionBlock(gif_, kForEver.size(), kForEver.data()) == GIF_OK &&
          EGifPutExtensionTrailer(gif_) == GIF_OK);
  }

  /// Whole ticks since the film began, so that rounding does not add up.
  void showFor(const Shown& shown) {
    const auto ticks = (shown.until_ms + kMsPerTick / 2) / kMsPerTick - (shown.from_ms + kMsPerTick / 2) / kMsPerTick;
    const GraphicsControlBlock control{
        DISPOSE_DO_NOT, false, static_cast<int>(std::clamp<std::int64_t>(ticks, 1, kMaxTicks)), NO_TRANSPARENT_COLOR};
    std::array<GifByteType, 4> block{};
    const std::size_t size = EGifGCBToExtension(&control, block.data());
    check(EGifPutExtension(gif_, GRAPHICS_EXT_FUNC_CODE, static_cast<int>(size), block.data()) == GIF_OK);
  }

  Painted paint(const view::Image& picture, const Rectangle& part) const {
    const std::size_t count = static_cast<std::size_t>(part.width) * part.height;
    std::array<std::vector<GifByteType>, 3> channels;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      channels[c].reserve(count);
      for (int y = 0; y < part.height; ++y) {
        for (int x = 0; x < part.width; ++x) channels[c].push_back(picture.at(part.left + x, part.top + y)[c]);
      }
    }
    Painted painted;
    painted.pixels.resize(count);
    check(GifQuantizeBuffer(part.width, part.height, &painted.colours, channels[0].data(), channels[1].data(),
                            channels[2].data(), painted.pixels.data(), painted.palette.data()) == GIF_OK);
    return painted;
  }

  GifFileType* gif_ = nullptr;
  std::string bytes_;  // compressed, not yet handed over
  view::Image before_;
};

}  // namespace

std::unique_ptr<Film> beginGif(const std::filesystem::path& file, const FilmFormat& format) {
  return std::make_unique<GifFilm>(file, format);
}

}  // namespace palpate::film
