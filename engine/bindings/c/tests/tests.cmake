# Tests of the C interface, included by engine/bindings/c/CMakeLists.txt: `ctest -R '^c\.'`.
set(tests ${CMAKE_CURRENT_SOURCE_DIR}/tests)
set(c_stage ${CMAKE_CURRENT_BINARY_DIR}/tests)

# palpate_add_c_test(<name> <library> <source> [<argument>...]): the test c.<name>
function(palpate_add_c_test name library source)
  add_executable(test_c_${name} ${tests}/${source})
  target_link_libraries(test_c_${name} PRIVATE ${library} m Threads::Threads $<$<BOOL:${WIN32}>:-static>)
  target_compile_definitions(test_c_${name} PRIVATE PALPATE_VERSION="${PROJECT_VERSION}")
  target_compile_options(test_c_${name} PRIVATE -Wall -Wextra $<$<COMPILE_LANGUAGE:C>:-Wpedantic>)
  set_target_properties(test_c_${name} PROPERTIES C_STANDARD 99 C_EXTENSIONS OFF)
  add_test(NAME c.${name} COMMAND test_c_${name} ${ARGN})
  set_tests_properties(c.${name} PROPERTIES TIMEOUT 300)
  if(TARGET first_circle)
    add_dependencies(first_circle test_c_${name})
  endif()
endfunction()

palpate_add_c_test(interface palpate_c interface_test.c)
palpate_add_c_test(threads palpate_c threads_test.c)
palpate_add_c_test(layout palpate_c layout_test.c)
set_target_properties(test_c_layout PROPERTIES C_STANDARD 11)

set(kept_session ${PROJECT_SOURCE_DIR}/tests/data/sessions/version_5/trunk.session)
if(CMAKE_CROSSCOMPILING) # the rest needs programs of the system that is built for; tools/check-platforms runs these
  palpate_add_c_test(session palpate_c session_test.c ${kept_session})
  return()
endif()
palpate_add_c_test(forces palpate_c forces_test.cpp)
target_link_libraries(test_c_forces PRIVATE palpate palpate_lab palpate_build)
target_sources(test_c_forces PRIVATE ${PROJECT_SOURCE_DIR}/instruments/study/lab/counters/thread_counts.cpp) # before the C library's own

# A run of the command, then each of its ticks through the C interface.
if(TARGET palpate_command)
  add_test(NAME c.simulate COMMAND palpate_command simulate ${tests}/press.toml --session --no-pictures --no-plot --overwrite
           --out ${c_stage}/run)
  set_tests_properties(c.simulate PROPERTIES FIXTURES_SETUP c_run TIMEOUT 300)
  palpate_add_c_test(session palpate_c session_test.c ${kept_session} ${c_stage}/run/run.session)
  set_tests_properties(c.session PROPERTIES FIXTURES_REQUIRED c_run)
else()
  palpate_add_c_test(session palpate_c session_test.c ${kept_session})
endif()

add_test(NAME c.header COMMAND ${tests}/check_header.sh ${PROJECT_SOURCE_DIR}/engine/bindings/c)
add_test(NAME c.exports COMMAND ${tests}/check_exports.sh $<TARGET_FILE:palpate_c> ${PROJECT_SOURCE_DIR}/engine/bindings/c/palpate.h
         ${PROJECT_SOURCE_DIR}/engine/bindings/c/samples/Palpate.cs)
add_test(NAME c.docs COMMAND ${tests}/check_docs.sh ${PROJECT_SOURCE_DIR} $<TARGET_FILE_DIR:palpate_c>)

# Structures as they were and as they will be: three programs on two libraries.
set(header ${PROJECT_SOURCE_DIR}/engine/bindings/c/palpate.h)
add_custom_command(OUTPUT ${c_stage}/shorter/palpate.h ${c_stage}/longer/palpate.h
                   COMMAND ${CMAKE_COMMAND} -DHEADER=${header} -DOUT=${c_stage} -P ${tests}/versions.cmake
                   DEPENDS ${header} ${tests}/versions.cmake)
add_custom_target(palpate_c_versions DEPENDS ${c_stage}/shorter/palpate.h ${c_stage}/longer/palpate.h)
palpate_add_c_objects(palpate_c_longer_objects ${c_stage}/longer)
add_dependencies(palpate_c_longer_objects palpate_c_versions)
palpate_add_c_library(palpate_c_longer palpate_c_longer_objects ${c_stage}/longer)
set_target_properties(palpate_c_longer PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${c_stage}/longer)
set(programs)
foreach(version shorter now longer)
  add_executable(test_c_versions_${version} ${tests}/versions_test.c)
  target_include_directories(test_c_versions_${version} BEFORE PRIVATE
                             $<IF:$<STREQUAL:${version},now>,${PROJECT_SOURCE_DIR}/engine/bindings/c,${c_stage}/${version}>)
  target_link_libraries(test_c_versions_${version} PRIVATE $<TARGET_LINKER_FILE:palpate_c>)
  # No path of its own: the test says which library is loaded.
  set_target_properties(test_c_versions_${version} PROPERTIES SKIP_BUILD_RPATH ON C_STANDARD 99)
  add_dependencies(test_c_versions_${version} palpate_c palpate_c_versions)
  list(APPEND programs $<TARGET_FILE:test_c_versions_${version}>)
endforeach()
add_test(NAME c.versions COMMAND ${tests}/compare_versions.sh $<TARGET_FILE_DIR:palpate_c> $<TARGET_FILE_DIR:palpate_c_longer>
         -- ${programs})

add_dependencies(first_circle palpate_c sample_c_feel_a_back)

# Samples. What needs a program that is not there is skipped by name.
add_test(NAME c.sample_c COMMAND sample_c_feel_a_back)
add_test(NAME c.sample_csharp COMMAND ${tests}/run_csharp.sh ${PROJECT_SOURCE_DIR}/engine/bindings/c/samples $<TARGET_FILE_DIR:palpate_c>
         ${c_stage}/csharp)
add_test(NAME c.sample_ctypes COMMAND ${tests}/run_ctypes.sh ${PROJECT_SOURCE_DIR}/engine/bindings/c/samples $<TARGET_FILE:palpate_c>)

# The gate of the binary form reads what the compiler tells debuggers, all of it.
find_program(PALPATE_ABIDW abidw)
if(PALPATE_ABIDW)
  palpate_add_c_library(palpate_c_abi palpate_c_objects ${PROJECT_SOURCE_DIR}/engine/bindings/c)
  add_dependencies(first_circle palpate_c_abi)
  set_target_properties(palpate_c_abi PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/abi)
  add_test(NAME c.abi COMMAND ${PROJECT_SOURCE_DIR}/tools/check-abi $<TARGET_FILE:palpate_c_abi>)
else()
  add_test(NAME c.abi COMMAND ${PROJECT_SOURCE_DIR}/tools/check-abi) # says why it is skipped
endif()
add_test(NAME c.abi_gate COMMAND ${PROJECT_SOURCE_DIR}/tools/check-abi --self-test)
add_test(NAME c.packaging COMMAND ${tests}/check_packaging.sh ${PROJECT_SOURCE_DIR} ${CMAKE_BINARY_DIR} ${PROJECT_VERSION})
set_tests_properties(c.packaging c.sample_csharp c.sample_ctypes c.abi c.abi_gate PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 300)
