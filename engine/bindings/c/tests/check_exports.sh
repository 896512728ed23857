#!/usr/bin/env bash
# The library gives palpate_* to others and nothing else, and exactly what palpate.h declares; it wants no symbol that its
# libraries have not; Palpate.cs imports nothing else. Usage: check_exports.sh LIBRARY HEADER PALPATE_CS
set -euo pipefail
library=$1 header=$2 csharp=$3
given=$(nm -D --defined-only "$library" | awk '$2 != "A" { print $3 }' | sed 's/@.*//' | sort)
if grep -v '^palpate_' <<<"$given"; then echo "these are not ours to give"; exit 1; fi
declared=$(tr '\n' ' ' <"$header" | grep -o 'PALPATE_API [^;]*;' | grep -o 'palpate_[a-z0-9_]*(' | tr -d '(' | sort)
diff <(echo "$declared") <(echo "$given") || { echo "< declared, > given"; exit 1; }
imported=$(grep -o 'DllImport.*palpate_[a-z0-9_]*(' "$csharp" | grep -o 'palpate_[a-z0-9_]*' | sort -u)
[ -n "$imported" ] || { echo "Palpate.cs imports nothing"; exit 1; }
strange=$(comm -13 <(echo "$given") <(echo "$imported"))
[ -z "$strange" ] || { echo "Palpate.cs imports what nobody gives: $strange"; exit 1; }
soname=$(readelf -d "$library" | sed -n 's/.*SONAME.*\[\(.*\)\]/\1/p')
[ "$soname" = libpalpate.so.0 ] || { echo "the library calls itself $soname"; exit 1; }
echo "$(wc -l <<<"$given") functions, all of them declared"
