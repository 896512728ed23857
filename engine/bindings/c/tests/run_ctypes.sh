#!/usr/bin/env bash
# Runs the ctypes sample by the system's Python. Usage: run_ctypes.sh FOLDER_OF_SAMPLES LIBRARY
set -euo pipefail
python=/usr/bin/python3
[ -x $python ] || python=$(command -v python3) || { echo "skipped: python3 is not installed"; exit 77; }
exec "$python" "$1/feel_a_back.py" "$2"
