#!/usr/bin/env bash
# The bill of materials names what is known to be in the library, is what SPDX requires, is the same twice, and a spoilt one is
# refused; recipes can be read and say the version of the project.
# Usage: check_packaging.sh SOURCE_FOLDER BUILD_FOLDER VERSION
set -euo pipefail
source=$1 build=$2 version=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "$*"; exit 1; }

python3 -c 'import ast, sys; ast.parse(open(sys.argv[1]).read())' "$source/packaging/conan/conanfile.py"
grep -q "version = \"$version\"" "$source/packaging/conan/conanfile.py" || fail "the Conan recipe is of another version"
python3 - "$source/packaging/vcpkg/vcpkg.json" "$version" <<'PYTHON'
import json, re, sys
port = json.load(open(sys.argv[1]))
assert port["version-semver"] == sys.argv[2], "the vcpkg port is of another version"
assert re.match(r"^[a-z0-9]+(-[a-z0-9]+)*$", port["name"]) and port["license"] == "Apache-2.0"
for dependency in port["dependencies"]:
    name = dependency if isinstance(dependency, str) else dependency["name"]
    assert re.match(r"^[a-z0-9]+(-[a-z0-9]+)*$", name), name
PYTHON
# As CMake reads it, with the functions of vcpkg taken for granted.
{
  for function in vcpkg_check_features vcpkg_cmake_configure vcpkg_cmake_install vcpkg_cmake_config_fixup vcpkg_fixup_pkgconfig vcpkg_install_copyright; do
    echo "function($function)"; echo "endfunction()"
  done
  echo "set(CURRENT_PACKAGES_DIR \"$work/none\")"
  cat "$source/packaging/vcpkg/portfile.cmake"
} >"$work/port.cmake"
cmake -P "$work/port.cmake"

export SOURCE_DATE_EPOCH=1700000000
"$source/tools/sbom" --build "$build" --out "$work/one.json" palpate_c || exit $?
"$source/tools/sbom" --build "$build" --out "$work/two.json" palpate_c
cmp "$work/one.json" "$work/two.json"
"$source/tools/sbom" --check "$work/one.json"
for package in libsqlite3-0 libfmt9 libeigen3-dev libstdc++6; do
  grep -q "\"name\": \"$package\"" "$work/one.json" || fail "$package is missing"
done
for spoil in 's/CC0-1.0/MIT/' 's/"relatedSpdxElement": "SPDXRef-libfmt9"/"relatedSpdxElement": "SPDXRef-lost"/' 's/"versionInfo": "[^"]*"/"versionInfo": ""/' 's/2023-/then-/'; do
  sed "$spoil" "$work/one.json" >"$work/spoilt.json"
  ! cmp -s "$work/one.json" "$work/spoilt.json" || fail "$spoil changes nothing"
  ! "$source/tools/sbom" --check "$work/spoilt.json" 2>/dev/null || fail "spoilt by $spoil it passes"
done
echo "what is spoilt is refused"
