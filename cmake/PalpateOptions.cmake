# A compiler's launcher that somebody chose stays; Emscripten keeps its own cache.
find_program(PALPATE_CCACHE_PROGRAM ccache)
mark_as_advanced(PALPATE_CCACHE_PROGRAM)
if(PALPATE_CCACHE AND PALPATE_CCACHE_PROGRAM AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER AND NOT EMSCRIPTEN)
  # Precompiled headers are kept as well; they need what ccache's manual names under "Precompiled headers". Paths count from
  # the repository, so that what one clone has compiled answers in the next.
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1
                                  CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
                                  ${PALPATE_CCACHE_PROGRAM})
  set(PALPATE_CACHED_PRECOMPILED $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endif()

# Compiler settings shared by every target of this project, as interface targets that are never exported.
add_library(palpate_options INTERFACE)
# Bit-identical forces: a fused multiply-add rounds once instead of twice, which breaks both reproducibility and the exact
# predicates (docs/explanation/contact.md). Never -ffast-math, never -march=native in a released build.
target_compile_options(palpate_options INTERFACE -ffp-contract=off -Wall -Wextra -Wnon-virtual-dtor ${PALPATE_CACHED_PRECOMPILED})
# Tests of boxes join comparisons by & on purpose, to have no branch between them.
target_compile_options(palpate_options INTERFACE $<$<CXX_COMPILER_ID:Clang>:-Wno-bitwise-instead-of-logical>)
# Not where files are compiled together: a local may bear the name of a neighbour's helper. tools/check-alone, which compiles
# each file by itself, has the warning for all of them.
target_compile_options(palpate_options INTERFACE $<$<NOT:$<BOOL:$<TARGET_PROPERTY:UNITY_BUILD>>>:-Wshadow>)
if(WIN32) # the compiler's own libraries go into the programs: whoever gets one needs no other file
  target_link_options(palpate_options INTERFACE -static)
endif()
if(PALPATE_WERROR)
  # But not those that depend on what the optimiser could see.
  target_compile_options(palpate_options INTERFACE -Werror
    $<$<CXX_COMPILER_ID:GNU>:-Wno-error=maybe-uninitialized;-Wno-error=array-bounds;-Wno-error=stringop-overflow;-Wno-error=restrict>)
endif()
if(PALPATE_SANITIZE)
  target_compile_options(palpate_options INTERFACE -fsanitize=${PALPATE_SANITIZE} -fno-omit-frame-pointer
                                                   -fno-sanitize-recover=undefined)
  target_link_options(palpate_options INTERFACE -fsanitize=${PALPATE_SANITIZE})
endif()
if(PALPATE_BUILD_FUZZERS) # the engine counts its branches for the fuzzers; other programs of that tree need the counters too
  target_compile_options(palpate_options INTERFACE -fsanitize=fuzzer-no-link)
  target_link_options(palpate_options INTERFACE -fsanitize=fuzzer-no-link)
endif()

# Where each house lies (ARCHITECTURE.md): PALPATE_HOUSE_core and so on.
foreach(house core host view cli bindings web)
  set(PALPATE_HOUSE_${house} ${PROJECT_SOURCE_DIR}/engine/${house})
endforeach()
foreach(house report measure teach class)
  set(PALPATE_HOUSE_${house} ${PROJECT_SOURCE_DIR}/instruments/${house})
endforeach()
foreach(house solve lab dissertation)
  set(PALPATE_HOUSE_${house} ${PROJECT_SOURCE_DIR}/instruments/study/${house})
endforeach()

# The same for what is compiled inside this source tree. A header is named by its house, "cli/kit/options.h", or below
# "palpate/", as it is installed.
add_library(palpate_build INTERFACE)
target_link_libraries(palpate_build INTERFACE palpate_options)
set(PALPATE_INCLUDE_FOLDERS ${PROJECT_SOURCE_DIR}/engine ${PROJECT_SOURCE_DIR}/instruments ${PROJECT_SOURCE_DIR}/instruments/study
                            ${PALPATE_HOUSE_core} ${PALPATE_HOUSE_host} ${PALPATE_HOUSE_view} ${PALPATE_HOUSE_measure}
                            ${PALPATE_HOUSE_teach} ${PALPATE_HOUSE_class} ${PALPATE_HOUSE_solve})
target_include_directories(palpate_build INTERFACE ${PALPATE_INCLUDE_FOLDERS})
# One order of arithmetic everywhere: with Eigen's packets a sum of three is added in another order where there is SSE than
# where there is none. Three-vectors are no slower without.
target_compile_definitions(palpate_build INTERFACE EIGEN_DONT_VECTORIZE)
# A precompiled header fits only where every macro is defined that was defined where it was made; more do no harm.
target_compile_definitions(palpate_build INTERFACE $<TARGET_PROPERTY:hwy::hwy,INTERFACE_COMPILE_DEFINITIONS>
                                                   $<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)

# What is not measured need not be fast, it must compile fast: commands, panels, tests.
set(PALPATE_LIGHTLY_OPTIMISED $<$<CONFIG:Release>:-O1>)

# palpate_precompile(<target> <owner> [<header>...]): the target compiles with the precompiled header of `owner`, which is
# made, with more headers where these are named, when the owner itself comes by. All targets of one owner must agree in
# -fPIC, in -O0 or not, and in macros; GCC warns of a header that does not fit, and reads the text instead.
function(palpate_precompile target owner)
  if(NOT PALPATE_PRECOMPILE)
    return()
  endif()
  if(target STREQUAL owner)
    target_precompile_headers(${target} PRIVATE ${PROJECT_SOURCE_DIR}/cmake/precompiled.h ${ARGN})
  else()
    target_precompile_headers(${target} REUSE_FROM ${owner})
  endif()
endfunction()

# palpate_unite(<target>...): neighbours of these targets are compiled together, so that what they include is read and its
# templates made once. They then share their anonymous namespaces: a name in one must not stand in another of the target.
function(palpate_unite)
  if(NOT PALPATE_UNITY)
    return()
  endif()
  set_target_properties(${ARGN} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${PALPATE_UNITY_BATCH})
endfunction()

# The owner of the precompiled header of everything that goes into our own programs only.
add_library(palpate_programs OBJECT ${PROJECT_SOURCE_DIR}/cmake/precompiled.cpp)
target_link_libraries(palpate_programs PRIVATE palpate_build Eigen3::Eigen)
palpate_precompile(palpate_programs palpate_programs)
