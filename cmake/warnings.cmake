# Applied to every target of the project: warnings are errors.
function(octavo_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Wcast-qual
                         -Wextra-semi -Woverloaded-virtual -Werror)
  # Without AVX, compilers say of every function with a vector of 32 bytes that its ABI is not stable. Ours never leave
  # their source file. A pragma there does not do: GCC's last such warning comes when no place is known any more.
  target_compile_options(${target} PRIVATE -Wno-psabi)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # GCC 12 warns wrongly about copies inside std::string's operator+ (GCC bug 105651). With precompiled headers it
    # forgets that these lines are a system's, and warns of the same under more names.
    target_compile_options(${target} PRIVATE -Wno-restrict)
    if(NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
      target_compile_options(${target} PRIVATE -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds)
    endif()
  endif()
endfunction()
