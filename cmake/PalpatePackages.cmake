# Debian packages by CPack (tools/package makes and tries them), of what is built and tested, for Debian 12. packaging/debian/ makes the
# same ones the way that Debian does (docs/howto/release.md). Included last: it looks at which parts are built.
#
#   libpalpate0      libpalpate.so.0, the C interface
#   libpalpate-dev   palpate.h, Palpate.cs, the C++ library with its headers and CMake files
#   palpate          the command
#   palpate-FAMILY   what it starts: serve, report, measure, teach, class, study (engine/cli/kit/families.tsv)
#   python3-palpate  the Python package
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME palpate)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
# Any other title would be put before each package's own.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${CMAKE_PROJECT_NAME} built using CMake")
set(CPACK_PACKAGE_VENDOR "Palpate maintainers")
set(CPACK_PACKAGE_CONTACT "Palpate maintainers <maintainers@palpate.invalid>" CACHE STRING "Maintainer that the packages name")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_OUTPUT_FILE_PREFIX ${CMAKE_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/packaging/cpack/compress_pages.cmake)
configure_file(packaging/cpack/changelog.in debian/changelog @ONLY)
execute_process(COMMAND gzip -9nc ${CMAKE_BINARY_DIR}/debian/changelog OUTPUT_FILE ${CMAKE_BINARY_DIR}/debian/changelog.gz)

# palpate_package(<group> <package> <components> <section> <description>): the first line of the description is its title.
function(palpate_package group package components section description)
  string(TOUPPER ${group} upper)
  foreach(component ${components})
    string(TOUPPER ${component} component_upper)
    set(CPACK_COMPONENT_${component_upper}_GROUP ${group} PARENT_SCOPE)
  endforeach()
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${components} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${description}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SHLIBDEPS ON PARENT_SCOPE)
  list(GET components 0 first)
  install(FILES ${PROJECT_SOURCE_DIR}/packaging/debian/copyright ${CMAKE_BINARY_DIR}/debian/changelog.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
          COMPONENT ${first} EXCLUDE_FROM_ALL)
endfunction()

# What was installed without a component is for who writes C++.
set(CPACK_COMPONENTS_ALL)
set(development Unspecified)
if(TARGET palpate_c)
  palpate_package(lib libpalpate0 library libs
                  "haptic palpation: the C library\nBodies that can be felt, fingers that feel them and skin that follows,\nfor programs in C, C# and other languages.")
  # CPACK_..._GENERATE_SHLIBS writes none here; the trigger is Debian's way, beside the scripts that CPack adds by itself.
  set(CPACK_DEBIAN_LIB_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/packaging/cpack/shlibs ${PROJECT_SOURCE_DIR}/packaging/cpack/triggers)
  set(development development Unspecified)
endif()
palpate_package(dev libpalpate-dev "${development}" libdevel
                "haptic palpation: files for developers\nThe header of the C library, Palpate.cs for C# and Unity, and the C++ library\nwith its headers and CMake files.")
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libeigen3-dev, libfmt-dev, libhwy-dev, libtomlplusplus-dev, libsqlite3-dev, zlib1g-dev")
if(TARGET palpate_c)
  string(APPEND CPACK_DEBIAN_DEV_PACKAGE_DEPENDS ", libpalpate0 (= ${PROJECT_VERSION})")
endif()
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS "libepoxy-dev, libimgui-dev, libopencv-dev") # for drawing and photographs
set(CPACK_DEBIAN_DEV_PACKAGE_SHLIBDEPS OFF) # archives need nothing to run
if(TARGET palpate_command)
  palpate_package(cmd palpate command science
                  "haptic palpation: feel, see and measure touch on a soft body\nThe command palpate: simulate, run with devices, record and replay palpation.")
  set(CPACK_DEBIAN_CMD_PACKAGE_DEPENDS "libegl1, libgl1") # opened at run time; libepoxy aborts without
endif()
macro(palpate_family_package family what) # no scope of its own: palpate_package sets what is read at the end
  if(TARGET palpate_${family}_family)
    palpate_package(${family} palpate-${family} ${family} science "${what}")
    string(TOUPPER ${family} upper)
    set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "palpate (= ${PROJECT_VERSION})")
  endif()
endmacro()
palpate_family_package(serve "haptic palpation: in browsers\npalpate serve: feel here, with devices, and show it in browsers.")
palpate_family_package(report "haptic palpation: plots, maps and reports\npalpate recording report, recording plot, body map.")
palpate_family_package(measure "haptic palpation: measuring from photographs\npalpate measure: how far skin follows a finger, from photographs of dots.")
palpate_family_package(teach "haptic palpation: training\npalpate train: training, examination, their records.")
palpate_family_package(class "haptic palpation: classes\npalpate class: a class over the network.")
set(CPACK_DEBIAN_CLASS_PACKAGE_DEPENDS "${CPACK_DEBIAN_CLASS_PACKAGE_DEPENDS}, palpate-teach (= ${PROJECT_VERSION})")
palpate_family_package(study "haptic palpation: studies\npalpate study, palpate tissue: the dissertation's numbers and figures,\nfinite elements of tissue, benchmarks.")
if(TARGET palpate_python)
  # A module fits one minor version of Python.
  execute_process(COMMAND ${Python3_EXECUTABLE} -c "import sys; print(sys.version_info.major, sys.version_info.minor, sys.version_info.minor + 1, sep=';')"
                  OUTPUT_VARIABLE python OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  list(GET python 0 major)
  list(GET python 1 minor)
  list(GET python 2 next)
  palpate_package(py python3-palpate python python
                  "haptic palpation: the Python package\nWorlds, fingers, skin, pictures and sessions of Palpate for numpy.")
  set(CPACK_DEBIAN_PY_PACKAGE_RECOMMENDS libegl1) # pictures
  set(CPACK_DEBIAN_PY_PACKAGE_DEPENDS "python3 (>= ${major}.${minor}), python3 (<< ${major}.${next}), python3-numpy")
endif()
if(PALPATE_ASSIMP) # opened when it is asked for, so that nothing tells of it
  string(REGEX REPLACE "^(lib[a-z]+)\\.so\\.([0-9]+)$" "\\1\\2" assimp_package ${PALPATE_ASSIMP_FILE})
  set(CPACK_DEBIAN_LIB_PACKAGE_RECOMMENDS ${assimp_package})
  set(CPACK_DEBIAN_CMD_PACKAGE_RECOMMENDS ${assimp_package})
  string(APPEND CPACK_DEBIAN_PY_PACKAGE_RECOMMENDS ", ${assimp_package}")
endif()
include(CPack)
