// Pictures one after the other -> a film (MP4, WebM), by the system's ffmpeg where it is installed. ffmpeg is a program
// beside this one, never a part of it: it is given raw pictures through a socket, and an argument list, never a shell.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "palpate/base/output_file.h"
#include "palpate/view/image.h"

namespace palpate::app {

/// By its extension: .mp4 or .webm.
bool isFilm(const std::filesystem::path& file);

/// The first ffmpeg on PATH; nothing when there is none.
std::optional<std::filesystem::path> installedFfmpeg();

struct FilmFormat {
  view::ImageSize size;  ///< of every picture; odd sides get a black row or column
  double frames_per_s = 25.0;
};

/// What one types to make the film of numbered pictures, FILM_0001.png and so on beside it.
std::string commandToJoin(const std::filesystem::path& film, double frames_per_s);

class FilmWriter {
 public:
  /// Starts ffmpeg. Throws Error naming the film.
  FilmWriter(const std::filesystem::path& ffmpeg, const std::filesystem::path& film, const FilmFormat& format);
  /// Without `finish` ffmpeg is ended and no film is left.
  ~FilmWriter();
  FilmWriter(const FilmWriter&) = delete;
  FilmWriter& operator=(const FilmWriter&) = delete;

  /// Throws Error with ffmpeg's own last words when it has given up.
  void add(const view::Image& picture);
  /// Waits for ffmpeg; the film appears under its name. Throws Error like `add`.
  void finish();

 private:
  void start(const std::filesystem::path& ffmpeg, const FilmFormat& format);
  void closeInput();
  /// ffmpeg's wait status; it has ended then.
  int wait();
  [[noreturn]] void fail(int status);

  std::filesystem::path film_;
  OutputFile output_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> words_;  // what ffmpeg says goes wrong: a file without a name
  int input_ = -1;                                         // our end of the socket
  int process_ = -1;
};

}  // namespace palpate::app
