# Rooms: one folder of a house, one object library, in the order of ARCHITECTURE.md. A room may use those before it, and a
# test links the rooms up to its own and no others.
set(PALPATE_CORE_ROOMS base mesh body tissue maps tree contact hdb deform trace scene device servo engine)
set(PALPATE_HOST_ROOMS base mesh tissue trace scene device servo engine)

# Files of one system alone; `posix` is every other than Windows.
if(WIN32)
  set(PALPATE_FOREIGN_SYSTEMS posix linux apple)
elseif(APPLE)
  set(PALPATE_FOREIGN_SYSTEMS windows linux)
else()
  set(PALPATE_FOREIGN_SYSTEMS windows apple)
endif()

# palpate_glob(<variable> <folder>): the sources below the folder that are for the system that is built for.
function(palpate_glob variable folder)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${folder}/*.cpp)
  foreach(system ${PALPATE_FOREIGN_SYSTEMS})
    file(GLOB_RECURSE foreign CONFIGURE_DEPENDS ${folder}/*_${system}.cpp)
    list(REMOVE_ITEM sources ${foreign})
  endforeach()
  set(${variable} ${sources} PARENT_SCOPE)
endfunction()

# palpate_add_rooms(<house> <prefix> <room>...) compiles <house>/palpate/<room> as <prefix>_<room>.
function(palpate_add_rooms house prefix)
  set(folder ${PALPATE_HOUSE_${house}}/palpate)
  # These include themselves, once for each instruction set.
  set(vectors ${folder}/tree/wide_node.cpp ${folder}/tree/closest_on_triangles.cpp ${folder}/deform/kernels/kernels.cpp
              ${folder}/contact/nearby_skin.cpp ${folder}/contact/pad_cells.cpp)
  set_property(SOURCE ${vectors} PROPERTY SKIP_UNITY_BUILD_INCLUSION ON)
  if(CMAKE_SYSTEM_PROCESSOR STREQUAL aarch64)
    # Highway 1.0.3 takes its NEON from compilers that are told of AES (no such instruction is made), has no vectors of SVE in
    # structures, and GCC 12 fails on its header of SVE after a precompiled one.
    set_property(SOURCE ${vectors} PROPERTY COMPILE_OPTIONS -march=armv8-a+crypto)
    set_property(SOURCE ${vectors} PROPERTY COMPILE_DEFINITIONS HWY_COMPILE_ONLY_STATIC)
    set_property(SOURCE ${vectors} PROPERTY SKIP_PRECOMPILE_HEADERS ON)
  endif()
  set_property(SOURCE ${folder}/engine/recording_settings.cpp PROPERTY COMPILE_DEFINITIONS
               PALPATE_VERSION="${PROJECT_VERSION}") # recordings say what wrote them
  if(NOT PALPATE_THREADS)
    set_property(SOURCE ${folder}/base/host_environment.cpp PROPERTY COMPILE_DEFINITIONS PALPATE_NO_THREADS)
  endif()
  if(PALPATE_ASSIMP)
    set_property(SOURCE ${folder}/scene/host.cpp PROPERTY COMPILE_DEFINITIONS PALPATE_ASSIMP)
  endif()
  foreach(room ${ARGN})
    palpate_glob(sources ${folder}/${room})
    if(NOT PALPATE_ASSIMP)
      list(REMOVE_ITEM sources ${folder}/mesh/files/read_foreign.cpp)
    endif()
    if(NOT sources)
      continue() # a room of headers
    endif()
    set(target ${prefix}_${room})
    add_library(${target} OBJECT ${sources})
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_link_libraries(${target} PRIVATE palpate_build Eigen3::Eigen fmt::fmt hwy::hwy)
    if(house STREQUAL host)
      target_link_libraries(${target} PRIVATE tomlplusplus::tomlplusplus Threads::Threads)
      if(room STREQUAL mesh AND PALPATE_ASSIMP)
        target_include_directories(${target} SYSTEM PRIVATE $<TARGET_PROPERTY:assimp::assimp,INTERFACE_INCLUDE_DIRECTORIES>)
        set_property(SOURCE ${folder}/mesh/files/read_foreign.cpp PROPERTY COMPILE_DEFINITIONS
                     PALPATE_ASSIMP_FILE="${PALPATE_ASSIMP_FILE}")
      endif()
      if(room STREQUAL base) # base/json.cpp
        target_link_libraries(${target} PRIVATE nlohmann_json::nlohmann_json)
      endif()
    endif()
    palpate_precompile(${target} ${PALPATE_ROOM_HEADER_OWNER})
  endforeach()
endfunction()

# palpate_public_headers(<variable> <house> <folder below palpate/>...): every header that lies directly in these folders.
# What is not for others lies deeper, in `detail` for instance.
function(palpate_public_headers variable house)
  set(headers)
  foreach(folder ${ARGN})
    file(GLOB found CONFIGURE_DEPENDS ${PALPATE_HOUSE_${house}}/palpate/${folder}/*.h)
    list(APPEND headers ${found})
  endforeach()
  set(${variable} ${headers} PARENT_SCOPE)
endfunction()

# palpate_add_library(<target> <house> <folder>...): a static library of every source below these folders of a house, compiled in
# portions: what is around the engine.
function(palpate_add_library target house)
  set(sources)
  foreach(folder ${ARGN})
    palpate_glob(found ${PALPATE_HOUSE_${house}}/${folder})
    list(APPEND sources ${found})
  endforeach()
  add_library(${target} STATIC ${sources})
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:palpate_build>)
  palpate_unite(${target})
endfunction()

# palpate_add_commands(<target> <house> <folder>...): the same for commands: lightly optimised, with their precompiled header.
function(palpate_add_commands target house)
  palpate_add_library(${target} ${house} ${ARGN})
  target_compile_options(${target} PRIVATE ${PALPATE_LIGHTLY_OPTIMISED})
  palpate_precompile(${target} palpate_kit)
endfunction()

# palpate_embed_findings(<target> <house>): the texts of a house's findings (instruments/report/page/findings_text.h) are compiled in: the
# target includes <house>_findings_texts.h, where NAME_findings.txt is texts::NAME_findings.
function(palpate_embed_findings target house)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${PALPATE_HOUSE_${house}}/*_findings.txt)
  set(PALPATE_FINDINGS_TEXTS)
  foreach(file ${files})
    file(READ ${PROJECT_SOURCE_DIR}/${file} text)
    get_filename_component(name ${file} NAME_WE)
    string(APPEND PALPATE_FINDINGS_TEXTS "inline constexpr FindingsFile ${name}{\"${file}\", R\"text(${text})text\"};\n")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${file})
  endforeach()
  configure_file(${PROJECT_SOURCE_DIR}/instruments/report/page/findings_texts.h.in texts/${house}_findings_texts.h @ONLY)
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/texts)
endfunction()
