#!/usr/bin/env bash
# The first program of docs/reference/c-api.md, as it stands there, is compiled and run.
# Usage: check_docs.sh SOURCE_FOLDER FOLDER_OF_LIBRARY
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
awk '/^```c$/ { inside = 1; next } /^```$/ { if (inside) exit } inside' "$1/docs/reference/c-api.md" >"$work/press.c"
cc -std=c99 -Wall -Wpedantic -Werror -I"$1/engine/bindings/c" "$work/press.c" -L"$2" -lpalpate -Wl,-rpath,"$2" -o "$work/press"
said=$("$work/press")
echo "$said"
grep -q '^8.00 mm deep, [1-9]' <<<"$said"
