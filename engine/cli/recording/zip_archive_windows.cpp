#include <iowin32.h>

#include "cli/recording/zip_archive.h"

namespace palpate::app {

zipFile newZipArchive(const std::filesystem::path& file) {
  zlib_filefunc64_def functions;
  fill_win32_filefunc64W(&functions);
  return zipOpen2_64(file.c_str(), APPEND_STATUS_CREATE, nullptr, &functions);
}

}  // namespace palpate::app
