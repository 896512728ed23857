# OpenCV's core, imgproc and imgcodecs as the targets opencv_core, opencv_imgproc and opencv_imgcodecs. Debian's packages of
# single modules come without OpenCV's own CMake files: those are in the package of all modules, which nothing here needs.
find_package(OpenCV QUIET COMPONENTS core imgproc imgcodecs)
if(NOT OpenCV_FOUND)
  find_path(PALPATE_OPENCV_HEADERS opencv2/core.hpp PATH_SUFFIXES opencv4)
  set(PALPATE_OPENCV_FOUND TRUE)
  foreach(module core imgproc imgcodecs)
    find_library(PALPATE_OPENCV_${module} opencv_${module})
    if(NOT PALPATE_OPENCV_${module} OR NOT PALPATE_OPENCV_HEADERS)
      set(PALPATE_OPENCV_FOUND FALSE)
    elseif(NOT TARGET opencv_${module})
      add_library(opencv_${module} SHARED IMPORTED)
      set_target_properties(opencv_${module} PROPERTIES IMPORTED_LOCATION ${PALPATE_OPENCV_${module}}
                            INTERFACE_INCLUDE_DIRECTORIES ${PALPATE_OPENCV_HEADERS})
    endif()
  endforeach()
else()
  set(PALPATE_OPENCV_FOUND TRUE)
endif()
