// Copies a file into the program's read-only data when it is assembled: PALPATE_EMBED(name, "/path/of/the/file") makes
// name_begin and name_end. Once a file, outside any namespace.
#pragma once

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
