# Headers of other projects that are parsed once for all libraries, once for all programs and once for all tests: a third of the compile
# time. Only the root project uses them, and only with GCC; a package that is built by itself parses its own headers.
# One set for each way of generating code, as GCC accepts a precompiled header only with equal -fPIC or -fPIE, -O and macros.
# Plugins and Python modules parse their own, as they hide their symbols, benchmarks as they are optimised more than other programs.
option(PANVO_PRECOMPILED_HEADERS "Precompile common headers. OFF shows missing includes (as in the preset debug)" ON)
if(NOT PANVO_PRECOMPILED_HEADERS OR NOT CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  return()
endif()

include(CTest)
find_package(Eigen3 REQUIRED)
find_package(OpenCV REQUIRED COMPONENTS core imgproc)
find_package(fmt REQUIRED)
# Debian 13's tinyxml2 passes this macro to all that use Fast DDS.
find_package(tinyxml2 REQUIRED)
get_target_property(tinyxml2_macros tinyxml2::tinyxml2 INTERFACE_COMPILE_DEFINITIONS)
string(REGEX MATCH "_FILE_OFFSET_BITS=64" file_offset_macro "${tinyxml2_macros}")

# _panvo_precompile(panvo_headers_of_<kind> [PROGRAM] HEADERS ... [LINK ...])
function(_panvo_precompile target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "PROGRAM" "" "HEADERS;LINK")
  set(source ${CMAKE_BINARY_DIR}/precompiled/${target}.cpp)
  file(GENERATE OUTPUT ${source} CONTENT "")
  add_library(${target} OBJECT EXCLUDE_FROM_ALL ${source})
  target_link_libraries(${target} PRIVATE Eigen3::Eigen opencv_core opencv_imgproc fmt::fmt ${arg_LINK})
  _panvo_compile_settings(${target})
  target_compile_definitions(${target} PRIVATE ${file_offset_macro})
  if(arg_PROGRAM)
    target_compile_options(${target} PRIVATE -fPIE)
    _panvo_optimise_little(${target})
  endif()
  list(TRANSFORM arg_HEADERS REPLACE "^(.+)$" "$<$<COMPILE_LANGUAGE:CXX>:<\\1$<ANGLE-R>>")
  target_precompile_headers(${target} PRIVATE ${arg_HEADERS})
endfunction()

set(common algorithm array atomic chrono cmath condition_variable cstdint filesystem fstream functional map memory mutex numbers numeric
  optional ranges set span sstream stdexcept string string_view thread tuple unordered_map utility variant vector
  fmt/format.h fmt/ranges.h Eigen/Core Eigen/Geometry Eigen/LU Eigen/Cholesky opencv2/core.hpp opencv2/imgproc.hpp)
_panvo_precompile(panvo_headers_of_libraries HEADERS ${common})
_panvo_precompile(panvo_headers_of_programs PROGRAM HEADERS ${common})
if(BUILD_TESTING)
  find_package(GTest REQUIRED)
  _panvo_precompile(panvo_headers_of_tests PROGRAM HEADERS ${common} gmock/gmock.h gtest/gtest.h LINK GTest::gmock)
endif()
