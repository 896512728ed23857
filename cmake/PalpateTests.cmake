# How a house adds its tests: <house>/tests/<folder>/*.cpp becomes the program test_<folder>, whose suites are <folder>.Suite.
find_package(GTest REQUIRED)
find_package(rapidcheck REQUIRED)
set(PALPATE_TEST_FOLDER ${CMAKE_BINARY_DIR}/tests) # where the programs lie

add_library(palpate_test_build INTERFACE)
target_link_libraries(palpate_test_build INTERFACE palpate_build Eigen3::Eigen GTest::gtest rapidcheck nlohmann_json::nlohmann_json
                                                   fmt::fmt Threads::Threads)
target_compile_options(palpate_test_build INTERFACE ${PALPATE_LIGHTLY_OPTIMISED})
target_compile_definitions(palpate_test_build INTERFACE $<$<BOOL:${PALPATE_ASSIMP}>:PALPATE_ASSIMP>)
# A test names its own file: below the repository, so that every clone compiles the same text (ccache).
target_compile_options(palpate_test_build INTERFACE -fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=)
target_include_directories(palpate_test_build INTERFACE ${PROJECT_SOURCE_DIR}/tests)

# The second circle: names of suites, and `folder.*` for whole programs (tests/circles.tsv).
set(PALPATE_CIRCLES ${PROJECT_SOURCE_DIR}/tests/circles.tsv)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PALPATE_CIRCLES})
include(${PROJECT_SOURCE_DIR}/cmake/PalpateCircles.cmake)
palpate_read_circles(${PALPATE_CIRCLES} PALPATE_SECOND_CIRCLE)

# What ./test builds: programs whose suites are all in the second circle are left to ./test --all.
add_custom_target(first_circle)

# Labels the tests that this folder adds by name, at the folder's end.
function(palpate_label_tests)
  get_property(tests DIRECTORY PROPERTY TESTS)
  foreach(test IN LISTS tests)
    palpate_is_in_second_circle(${test} "${PALPATE_SECOND_CIRCLE}" second)
    if(second)
      set_property(TEST ${test} APPEND PROPERTY LABELS second)
    endif()
  endforeach()
endfunction()

file(WRITE ${CMAKE_BINARY_DIR}/test_environment.cmake
     "set(build \"${CMAKE_BINARY_DIR}\")\ninclude(\"${PROJECT_SOURCE_DIR}/cmake/PalpateTestEnvironment.cmake\")\n")
set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_BINARY_DIR}/test_environment.cmake)

# Helpers of many tests, and the one precompiled header of all.
file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tests/support/*.cpp)
add_library(palpate_test_support STATIC ${sources})
set_source_files_properties(${PROJECT_SOURCE_DIR}/tests/support/places.cpp PROPERTIES COMPILE_DEFINITIONS
                            "PALPATE_SOURCE_DIR=\"${PROJECT_SOURCE_DIR}\";PALPATE_BINARY_DIR=\"${CMAKE_BINARY_DIR}\"")
target_link_libraries(palpate_test_support PRIVATE palpate_test_build)
palpate_precompile(palpate_test_support palpate_test_support <gtest/gtest.h>)

foreach(install installHost installHostEnvironment)
  add_library(palpate_test_${install} OBJECT ${PROJECT_SOURCE_DIR}/tests/support/main/main.cpp)
  target_link_libraries(palpate_test_${install} PRIVATE palpate_test_build)
  target_compile_definitions(palpate_test_${install} PRIVATE PALPATE_INSTALL=${install})
endforeach()

# palpate_add_test(<folder> <library>...): of the house that calls, or of the whole.
function(palpate_add_test folder)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/tests/${folder}/*.cpp)
  if(CMAKE_CURRENT_SOURCE_DIR STREQUAL "${PROJECT_SOURCE_DIR}/tests")
    file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp)
  endif()
  set(target test_${folder})
  add_executable(${target} ${sources})
  set(main palpate_test_installHost)
  if("palpate_host_base" IN_LIST ARGN AND NOT "palpate_host_scene" IN_LIST ARGN) # a room before the one that has installHost
    set(main palpate_test_installHostEnvironment)
  endif()
  target_link_libraries(${target} PRIVATE ${main} palpate_test_support ${ARGN} palpate_test_build)
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PALPATE_TEST_FOLDER})
  palpate_precompile(${target} palpate_test_support)
  palpate_unite(${target})
  palpate_is_in_second_circle("${folder}.*" "${PALPATE_SECOND_CIRCLE}" second)
  if(NOT second)
    add_dependencies(first_circle ${target})
  endif()
  file(GENERATE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${target}.cmake CONTENT "set(folder ${folder})
set(program $<TARGET_FILE:${target}>)
set(list ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
set(where ${PALPATE_TEST_FOLDER})
set(circles ${PALPATE_CIRCLES})
include(${PROJECT_SOURCE_DIR}/cmake/PalpateSuites.cmake)
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/${target}.cmake)
endfunction()

# The test starts the built command.
function(palpate_runs_the_command test)
  set_property(GLOBAL APPEND PROPERTY PALPATE_RUNNERS ${test})
endfunction()
