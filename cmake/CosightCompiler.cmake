# The compiler's settings: C++20, warnings as errors, and the build types of CMakePresets.json.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_C_STANDARD 11)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)

option(COSIGHT_NATIVE "Compile for this machine's own instruction set (results may differ in the last bits)" OFF)
option(COSIGHT_TIDY "Run clang-tidy beside the compiler" OFF)
set(COSIGHT_SANITIZE "" CACHE STRING "Sanitizers, as for -fsanitize=")

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Dev, Release or Sanitize" FORCE)
endif()
# Eigen without optimisation is a hundred times slower than with it: even Dev optimises; it keeps the asserts.
set(CMAKE_CXX_FLAGS_DEV "-O2 -g1" CACHE STRING "" FORCE)
set(CMAKE_C_FLAGS_DEV "-O2 -g1" CACHE STRING "" FORCE)
set(CMAKE_CXX_FLAGS_SANITIZE "-O1 -g1 -fno-omit-frame-pointer" CACHE STRING "" FORCE)
set(CMAKE_C_FLAGS_SANITIZE "-O1 -g1 -fno-omit-frame-pointer" CACHE STRING "" FORCE)
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG" CACHE STRING "" FORCE)

add_library(cosight_options INTERFACE)
target_compile_options(cosight_options INTERFACE
  $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wshadow -Wconversion -Wnon-virtual-dtor -Woverloaded-virtual -Werror>)
# GCC 12 warns of an overlap inside std::string wherever a literal is joined to a string (its bug 105651).
target_compile_options(cosight_options INTERFACE
  $<$<AND:$<COMPILE_LANGUAGE:CXX>,$<CXX_COMPILER_ID:GNU>>:-Wno-restrict>)
# The same input gives the same bytes out: no contraction into fused multiply-adds behind our back.
target_compile_options(cosight_options INTERFACE -ffp-contract=off)
target_include_directories(cosight_options INTERFACE ${PROJECT_SOURCE_DIR})
if(COSIGHT_NATIVE)
  target_compile_options(cosight_options INTERFACE -march=native)
endif()
if(COSIGHT_SANITIZE)
  add_compile_options(-fsanitize=${COSIGHT_SANITIZE} -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${COSIGHT_SANITIZE})
  # GCC's sanitizer instrumentation makes these warnings fire inside Eigen and the standard library.
  target_compile_options(cosight_options INTERFACE
    $<$<COMPILE_LANGUAGE:CXX>:-Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow -Wno-tsan>)
endif()
if(COSIGHT_TIDY)
  find_program(CLANG_TIDY NAMES clang-tidy clang-tidy-14 REQUIRED)
endif()

find_program(CCACHE ccache)
if(CCACHE)
  set(CMAKE_C_COMPILER_LAUNCHER ${CCACHE})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()
