#!/usr/bin/env bash
# Runs programs on libraries; all must print the same. Usage: compare_versions.sh FOLDER_OF_LIBRARY... -- PROGRAM...
set -euo pipefail
libraries=()
while [ "$1" != -- ]; do libraries+=("$1"); shift; done
shift
said=
for library in "${libraries[@]}"; do
  for program in "$@"; do
    felt=$(LD_LIBRARY_PATH=$library "$program") || { echo "$program on $library: $felt"; exit 1; }
    felt=${felt%%$'\n'*}
    echo "$(basename "$program") on $library: $felt"
    [ "${said:=$felt}" = "$felt" ] || { echo "not the same"; exit 1; }
  done
done
