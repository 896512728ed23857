# An overlay port: vcpkg install palpate --overlay-ports=packaging/vcpkg
# It builds the source tree that it lies in; a registry would fetch a release instead. Not tried:
# see docs/reference/c-api.md.
set(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../..")
vcpkg_check_features(OUT_FEATURE_OPTIONS FEATURE_OPTIONS FEATURES assimp PALPATE_ASSIMP)
vcpkg_cmake_configure(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS
    ${FEATURE_OPTIONS}
    -DPALPATE_BUILD_APPS=OFF
    -DPALPATE_BUILD_TESTS=OFF
    -DPALPATE_BUILD_EXAMPLES=OFF
    -DPALPATE_VIEW=OFF
    -DPALPATE_MEASURE=OFF
    -DPALPATE_BUILD_PYTHON=OFF
    -DPALPATE_PEERS=OFF
    -DPALPATE_BUILD_C=ON
)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(PACKAGE_NAME palpate CONFIG_PATH lib/cmake/palpate)
vcpkg_fixup_pkgconfig()
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/debug/include" "${CURRENT_PACKAGES_DIR}/debug/share")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
