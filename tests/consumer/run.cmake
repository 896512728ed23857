# Installs the built library into a fresh prefix, then configures, builds and runs the project beside this file on it.
set(work ${PALPATE_BINARY_DIR}/consumer)
file(REMOVE_RECURSE ${work})
function(run)
  execute_process(COMMAND ${ARGV} WORKING_DIRECTORY ${PALPATE_BINARY_DIR} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
run(${CMAKE_COMMAND} --install ${PALPATE_BINARY_DIR} --prefix ${work}/prefix)

# The code of docs/howto/pictures.md, as it stands there, with the names that it takes for granted.
file(READ ${CONSUMER_DIR}/../../docs/howto/pictures.md page)
string(REGEX MATCH "## From C\\+\\+\n\n```cpp\n([^`]*)```" found "${page}")
set(code "${CMAKE_MATCH_1}")
string(REGEX MATCHALL "#include [^\n]*\n" includes "${code}")
string(REGEX REPLACE "#include [^\n]*\n" "" code "${code}")
if(NOT includes OR NOT code)
  message(FATAL_ERROR "docs/howto/pictures.md has no code after '## From C++'")
endif()
string(CONCAT includes ${includes})
file(WRITE ${work}/page.cpp "${includes}
using namespace palpate;
void page(std::shared_ptr<const scene::World> world, const deform::DeformedSurface& surface,
          std::span<const view::FingerMark> fingers, double time_s, double head_x, double head_y, double head_z) {
${code}}
")

# The command works without the source tree.
if(EXISTS ${work}/prefix/bin/palpate)
  run(${CMAKE_COMMAND} -E chdir ${work}/prefix ./bin/palpate --version)
  run(${CMAKE_COMMAND} -E chdir ${work} ./prefix/bin/palpate simulate --seconds 0.1 --no-pictures --out simulated)
endif()

run(${CMAKE_COMMAND} -S ${CONSUMER_DIR} -B ${work}/build -G Ninja -DPAGE_SOURCE=${work}/page.cpp -DCMAKE_PREFIX_PATH=${work}/prefix
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${work}/build)
run(${CMAKE_COMMAND} -E chdir ${work}/build ./feel_and_deform)

# Drawing: where the component was installed it is built, and it draws where there is OpenGL.
file(GLOB_RECURSE view_component ${work}/prefix/palpateViewTargets.cmake)
if(NOT view_component)
  message("nothing is drawn: the view component is not installed")
  return()
endif()
if(NOT EXISTS ${work}/build/draw)
  message(FATAL_ERROR "the view component is installed, but a project that asks for it does not find it")
endif()
execute_process(COMMAND ./draw WORKING_DIRECTORY ${work}/build RESULT_VARIABLE result)
if(result EQUAL 77)
  message("nothing is drawn: this machine has no OpenGL")
elseif(NOT result EQUAL 0)
  message(FATAL_ERROR "draw ended with ${result}")
endif()
