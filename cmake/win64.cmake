# Windows on x86-64, by mingw-w64 with POSIX threads; its programs run under Wine.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
# Those of tools/platform-libraries, where it has been.
set(libraries ${CMAKE_CURRENT_LIST_DIR}/../build/libraries/win64)
set(CMAKE_FIND_ROOT_PATH ${libraries} /usr/x86_64-w64-mingw32)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_LIBDIR} ${libraries}/lib/pkgconfig)
set(CMAKE_CROSSCOMPILING_EMULATOR /usr/lib/wine/wine64)
set(Boost_NO_BOOST_CMAKE ON) # its headers alone
set(OPENSSL_USE_STATIC_LIBS ON)
