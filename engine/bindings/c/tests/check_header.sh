#!/usr/bin/env bash
# palpate.h by itself in every language that it promises, without a warning. Usage: check_header.sh HEADER_FOLDER
# With --self-test: a header with C99's comments must be refused, and one with a warning.
set -euo pipefail
folder=$1
check() { # FOLDER
  local source
  source=$(mktemp -d)
  trap 'rm -rf "$source"' RETURN
  # What a program does with it, so that macros and types are looked at too.
  cat >"$source/use.c" <<'C'
#include "palpate.h"
extern palpate_touch touch;
palpate_touch touch;
int32_t use(palpate_finger* finger);
int32_t use(palpate_finger* finger) {
  static const double tip[3] = {0, 0, 0};
  touch.size = sizeof touch;
  return palpate_finger_step(finger, tip, &touch) == PALPATE_OK && touch.status != PALPATE_TIP_LOST &&
         touch.triangle != PALPATE_NONE;
}
C
  cp "$source/use.c" "$source/use.cpp"
  local compiled=0 compiler standard
  for compiler in gcc clang; do
    command -v $compiler >/dev/null || continue
    for standard in c89 c99 c11; do
      $compiler -std=$standard -fsyntax-only -Wall -Wextra -Wpedantic -Wstrict-prototypes -Wc++-compat -Werror -I"$1" "$source/use.c" || return 1
      compiled=$((compiled + 1))
    done
    for standard in c++11 c++14 c++17 c++20; do
      $compiler -x c++ -std=$standard -fsyntax-only -Wall -Wextra -Wpedantic -Wold-style-cast -Werror -I"$1" "$source/use.cpp" || return 1
      compiled=$((compiled + 1))
    done
  done
  [ $compiled -ge 7 ] && echo "$compiled compilations without a warning"
}
check "$folder"
spoilt=$(mktemp -d)
trap 'rm -rf "$spoilt"' EXIT
sed 's#^typedef struct palpate_touch {#// a comment that C89 has not\n&#' "$folder/palpate.h" >"$spoilt/palpate.h"
if check "$spoilt" >/dev/null 2>&1; then echo "a header that is no C89 passes"; exit 1; fi
echo "a header that is no C89 is refused"
