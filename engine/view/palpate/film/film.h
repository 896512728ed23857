// Pictures -> a film, without another program: WebM (VP9, through libvpx) and animated GIF (through giflib), by the
// ending of the file's name.
//
//   picture, moment ─► Film::add ─► compressed ─► OutputFile: the film appears whole at `finish`, or not at all
#pragma once

#include <filesystem>
#include <memory>

#include "palpate/base/output_file.h"
#include "palpate/view/image.h"

namespace palpate::film {

/// Whether the name ends in .webm or .gif.
bool isOwnFilm(const std::filesystem::path& file);

/// The time budget per picture.
enum class Effort {
  careful,  ///< small files, about five pictures a second of 1280x800
  live,     ///< faster than a film is shown
};

struct FilmFormat {
  view::ImageSize size;
  double frames_per_s = 25.0;  ///< how long the last picture is shown
  Effort effort = Effort::careful;
};

/// One thread at a time. Without `finish` no file is left.
class Film {
 public:
  virtual ~Film() = default;
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;

  /// The picture is shown from this moment (s, rising; the first one begins the film). Throws Error naming the film:
  /// another size, a full disk, a film that has grown too large.
  void add(const view::Image& picture, double at_s);
  /// The film appears under its name. Throws Error where it cannot be written or has no picture.
  void finish();

  const std::filesystem::path& file() const { return file_; }

 protected:
  /// Throws Error when the file cannot be written.
  Film(std::filesystem::path file, const FilmFormat& format);
  [[noreturn]] void fail(std::string_view cause) const;

  /// A picture and how long it is shown, both in ms since the film began.
  struct Shown {
    std::int64_t from_ms = 0;
    std::int64_t until_ms = 0;
  };
  virtual void compress(const view::Image& picture, const Shown& shown) = 0;
  virtual void end() = 0;

  const FilmFormat format_;
  OutputFile output_;

 private:
  std::filesystem::path file_;
  view::Image last_;  // compressed when the next one shows how long it lasted
  std::int64_t last_ms_ = 0;
  double began_s_ = 0.0;
};

/// Throws Error: a name of another ending, a size or rate that the format cannot hold, a build without encoders.
void requireFilm(const std::filesystem::path& file, const FilmFormat& format);

/// Throws Error like `requireFilm`, and where the place cannot be written.
std::unique_ptr<Film> beginFilm(const std::filesystem::path& file, const FilmFormat& format);

// The formats among which `beginFilm` chooses.

std::unique_ptr<Film> beginGif(const std::filesystem::path& file, const FilmFormat& format);
std::unique_ptr<Film> beginWebm(const std::filesystem::path& file, const FilmFormat& format);

}  // namespace palpate::film
