# Measurements, shared by the tests and by `palpate bench`.
file(GLOB PALPATE_BENCH_SOURCES CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/runs/*.cpp ${CMAKE_CURRENT_SOURCE_DIR}/literal/*.cpp
     ${CMAKE_CURRENT_SOURCE_DIR}/kernels/kernel*.cpp ${CMAKE_CURRENT_SOURCE_DIR}/kernels/reference_loops.cpp)
# What needs no library of a stranger; the rest of that folder has targets of its own.
foreach(file judge literal peer timed_answers)
  list(APPEND PALPATE_BENCH_SOURCES ${CMAKE_CURRENT_SOURCE_DIR}/peers/${file}.cpp)
endforeach()

add_library(palpate_bench STATIC ${PALPATE_BENCH_SOURCES})
target_link_libraries(palpate_bench PUBLIC palpate_lab palpate PRIVATE palpate_build fmt::fmt hwy::hwy)
palpate_precompile(palpate_bench palpate_lab)

# The Google Benchmark suite of the kernels (tools/bench-kernels); without the library it is left out.
if(PALPATE_BUILD_BENCHMARKS)
  find_package(benchmark QUIET)
  if(benchmark_FOUND)
    add_executable(palpate_kernels kernels/main.cpp)
    target_link_libraries(palpate_kernels PRIVATE palpate_bench palpate_build benchmark::benchmark)
  else()
    message(STATUS "Google Benchmark not found: palpate_kernels is not built")
  endif()
endif()
