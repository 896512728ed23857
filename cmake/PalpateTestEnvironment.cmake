# Read by ctest before it runs, with `build` set: bodies that tests make are kept in the build folder, shared by all test
# processes, and never in the cache of the user who runs them.
set(ENV{XDG_CACHE_HOME} "${build}/tests/cache")
