option(OCTAVO_BUILD_TESTS "Build the test suite" ON)
option(OCTAVO_BUILD_BENCHMARKS "Build the micro-benchmarks and the comparisons with peers that are installed" OFF)
option(OCTAVO_BUILD_FUZZERS "Build the libFuzzer targets (clang only)" OFF)
set(OCTAVO_ARCH "" CACHE STRING "Value of -march= for the whole build, for example native; empty is portable")
set(OCTAVO_SANITIZE "" CACHE STRING "Value of -fsanitize= for the whole build, for example address,undefined")

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()

# Error bounds of the floating-point filters are proved for separate multiplications and additions; a fused one
# would make results depend on the machine.
add_compile_options(-ffp-contract=off)
if(OCTAVO_ARCH)
  add_compile_options(-march=${OCTAVO_ARCH})
endif()
if(OCTAVO_SANITIZE)
  add_compile_options(-fsanitize=${OCTAVO_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${OCTAVO_SANITIZE})
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # Between the sanitizers' calls g++ 12 loses track of whether a std::optional holds something: false alarms.
    add_compile_options(-Wno-maybe-uninitialized)
  endif()
  if(OCTAVO_SANITIZE MATCHES undefined)
    # g++ 12 tests the address of a thread-local variable for null by the flags of the addition that makes it, which
    # the linker relaxes to one that sets none: false alarms. A null pointer that is followed crashes all the same.
    add_compile_options(-fno-sanitize=null)
  endif()
endif()
