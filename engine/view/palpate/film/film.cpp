#include "palpate/film/film.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "palpate/base/error.h"

namespace palpate::film {

namespace {

constexpr double kMsPerS = 1000.0;
/// A GIF counts in hundredths of a second, and browsers slow down pictures that last less than two.
constexpr double kMaxGifFramesPerS = 50.0;
constexpr int kMaxSide = 16383;  ///< libvpx counts the sides of a picture in fourteen bits

bool isGif(const std::filesystem::path& file) { return file.extension() == ".gif"; }

}  // namespace

bool isOwnFilm(const std::filesystem::path& file) { return isGif(file) || file.extension() == ".webm"; }

Film::Film(std::filesystem::path file, const FilmFormat& format)
    : format_(format), output_(file), file_(std::move(file)) {}

void Film::fail(std::string_view cause) const { throw Error::inFile(file_.string(), cause); }

void Film::add(const view::Image& picture, double at_s) {
  if (picture.width != format_.size.width || picture.height != format_.size.height) {
    fail(fmt::format("expected a picture of {} x {} pixels, got {} x {}", format_.size.width, format_.size.height,
                     picture.width, picture.height));
  }
  if (last_.pixels.empty()) {
    began_s_ = at_s;
  } else {
    const std::int64_t now_ms = std::max<std::int64_t>(last_ms_ + 1, std::llround((at_s - began_s_) * kMsPerS));
    compress(last_, {last_ms_, now_ms});
    last_ms_ = now_ms;
  }
  last_ = picture;
}

void Film::finish() {
  if (last_.pixels.empty()) fail("a film needs a picture");
  const std::int64_t frame_ms = std::max<std::int64_t>(1, std::llround(kMsPerS / format_.frames_per_s));
  compress(last_, {last_ms_, last_ms_ + frame_ms});
  end();
  output_.commit();
}

void requireFilm(const std::filesystem::path& file, const FilmFormat& format) {
  const auto refuse = [&](const std::string& cause) { throw Error::inFile(file.string(), cause); };
#ifdef PALPATE_NO_FILMS
  refuse("this build cannot write films (PALPATE_FILMS is off)");
#endif
  if (!isOwnFilm(file)) refuse("a film must be named *.webm or *.gif");
  if (std::max(format.size.width, format.size.height) > kMaxSide) {
    refuse(fmt::format("a film's pictures are at most {} pixels wide and high", kMaxSide));
  }
  if (isGif(file) && format.frames_per_s > kMaxGifFramesPerS) {
    refuse(fmt::format("a GIF shows at most {} pictures a second; .webm shows more", kMaxGifFramesPerS));
  }
}

std::unique_ptr<Film> beginFilm(const std::filesystem::path& file, const FilmFormat& format) {
  requireFilm(file, format);
#ifdef PALPATE_NO_FILMS
  return nullptr;
#else
  return isGif(file) ? beginGif(file, format) : beginWebm(file, format);
#endif
}

}  // namespace palpate::film
