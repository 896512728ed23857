// Copies a file into the program's read-only data when it is assembled: PALPATE_EMBED(name, "/path/of/the/file") makes
// name_begin and name_end. Once per file, outside any namespace.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#if defined(_WIN32)
#define PALPATE_READ_ONLY ".section .rdata,\"dr\"\n"
#define PALPATE_SYMBOL ""
#elif defined(__APPLE__)
#define PALPATE_READ_ONLY ".const_data\n"
#define PALPATE_SYMBOL "_"
#else
#define PALPATE_READ_ONLY ".section .rodata\n"
#define PALPATE_SYMBOL ""
#endif

// clang-format off
#define PALPATE_EMBED(name, file)        \
  asm(PALPATE_READ_ONLY                  \
      ".balign 16\n"                     \
      PALPATE_SYMBOL #name "_begin:\n"   \
      ".incbin \"" file "\"\n"           \
      PALPATE_SYMBOL #name "_end:\n"     \
      ".byte 0\n"                        \
      ".text\n");                        \
  extern "C" {                           \
  extern const unsigned char name##_begin[]; \
  extern const unsigned char name##_end[];   \
  }                                      \
  static_assert(true, "takes the semicolon")
// clang-format on

namespace palpate::view {

/// Such a file, by its name.
struct EmbeddedFile {
  EmbeddedFile(std::string_view its_name, const unsigned char* begin, const unsigned char* end)
      : name(its_name), bytes(reinterpret_cast<const char*>(begin), static_cast<std::size_t>(end - begin)) {}
  std::string_view name, bytes;
};

}  // namespace palpate::view
