#include "cli/recording/zip_archive.h"

namespace palpate::app {

zipFile newZipArchive(const std::filesystem::path& file) { return zipOpen64(file.c_str(), APPEND_STATUS_CREATE); }

}  // namespace palpate::app
