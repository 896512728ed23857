#!/usr/bin/env bash
# Compiles and runs the C# sample by Mono. Ends with 77 and says why where there is none.
# Usage: run_csharp.sh FOLDER_OF_SAMPLES FOLDER_OF_LIBRARY WORK_FOLDER
set -euo pipefail
samples=$1 library=$2 work=$3
for program in mcs mono; do
  command -v $program >/dev/null || { echo "skipped: $program is not installed (mono-mcs, mono-runtime)"; exit 77; }
done
mkdir -p "$work"
mcs -unsafe -warnaserror -out:"$work/unity_loop.exe" "$samples/Palpate.cs" "$samples/UnityLoop.cs"
LD_LIBRARY_PATH=$library mono "$work/unity_loop.exe"
