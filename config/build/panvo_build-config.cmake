# Shared by all panvo packages: compiler settings, install layout, exported targets, tests.
# What serves to compile against panvo is installed as the component libpanvo-dev, everything else as the default component.
# Used from the installed tree (colcon) and from the source tree (root CMakeLists.txt).
include_guard(DIRECTORY)
include(CMakePackageConfigHelpers)
include(CTest)
include(GNUInstallDirs)
include(${CMAKE_CURRENT_LIST_DIR}/panvo_fast_dds.cmake)

option(PANVO_WARNINGS_AS_ERRORS "Treat compiler warnings as errors" OFF)
set(PANVO_SANITIZE "" CACHE STRING "Sanitizers to build with: address, undefined, thread, or a comma-separated list")

option(PANVO_FUZZ "Build the fuzzers; all code gets libFuzzer's instrumentation and the address and undefined sanitizers. Needs clang" OFF)
if(PANVO_FUZZ AND NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  message(FATAL_ERROR "PANVO_FUZZ needs clang, not ${CMAKE_CXX_COMPILER_ID}; configure a separate build folder with -DCMAKE_CXX_COMPILER=clang++")
endif()

# Most of the compile time is spent on the headers of Eigen, OpenCV, Fast DDS and gtest; sources that are compiled together read them once.
# This is faster for a build from scratch. For daily edits OFF is faster (as in the preset debug, which clang-tidy and clangd use too).
# ON in panvo itself, whose sources of one target never define the same internal name (tests/lint).
option(PANVO_UNITY "Compile the sources of a target together, eight at a time" OFF)

find_program(PANVO_CCACHE ccache)
mark_as_advanced(PANVO_CCACHE)

# Headers for tests: beside this file in the source tree, one folder higher in the installed tree.
if(NOT TARGET panvo::test_headers)
  add_library(panvo::test_headers INTERFACE IMPORTED)
  if(EXISTS ${CMAKE_CURRENT_LIST_DIR}/test_support)
    target_include_directories(panvo::test_headers INTERFACE ${CMAKE_CURRENT_LIST_DIR}/test_support)
  else()
    target_include_directories(panvo::test_headers INTERFACE ${CMAKE_CURRENT_LIST_DIR}/../test_support)
  endif()
  set_target_properties(panvo::test_headers PROPERTIES SYSTEM FALSE)  # panvo's own headers: keep warnings
endif()

# All settings are properties of the target, so that find_package(panvo_build) does not affect other targets of the caller.
function(_panvo_compile_settings target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  # Installed plugins and libraries find each other relative to themselves, whatever the prefix.
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON EXPORT_COMPILE_COMMANDS ON
    INSTALL_RPATH "$ORIGIN;$ORIGIN/..;$ORIGIN/../${CMAKE_INSTALL_LIBDIR};$ORIGIN/../../${CMAKE_INSTALL_LIBDIR}" INSTALL_RPATH_USE_LINK_PATH ON)
  if(PANVO_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set_target_properties(${target} PROPERTIES CXX_COMPILER_LAUNCHER
      "${CMAKE_COMMAND};-E;env;CCACHE_SLOPPINESS=pch_defines,time_macros;${PANVO_CCACHE}")
  endif()
  # Without a build type: like Release.
  target_compile_options(${target} PRIVATE $<$<CONFIG:>:-O3> $<$<CONFIG:>:-DNDEBUG>)
  # -ffp-contract=off: same rounding on every machine, so that replays are bit-identical. -U__ARM_FEATURE_FMA: without fused operations in Eigen's
  # code for ARM, too.
  # -Wno-restrict: GCC 12 warns of overlapping strings where there are none (GCC bug 105651).
  # -Wno-maybe-uninitialized: from GCC 13 on, an std::optional without a value may count as read (GCC bug 80635).
  # -fno-gnu-unique: an STB_GNU_UNIQUE symbol would keep a plugin in memory after it is unloaded.
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor>
    -ffp-contract=off $<$<STREQUAL:${CMAKE_SYSTEM_PROCESSOR},aarch64>:-U__ARM_FEATURE_FMA>
    $<$<CXX_COMPILER_ID:GNU>:-fno-gnu-unique$<SEMICOLON>-Wno-restrict>
    $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,13>>:-Wno-maybe-uninitialized>
    $<$<BOOL:${PANVO_WARNINGS_AS_ERRORS}>:-Werror>)
  if(PANVO_FUZZ)
    # Without vptr and function, which need type information that the distribution's libraries do not have.
    target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize=vptr,function
      -fno-sanitize-recover=undefined -fno-omit-frame-pointer -g)
    target_link_options(${target} PRIVATE -fsanitize=fuzzer-no-link,address,undefined)
  endif()
  if(PANVO_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${PANVO_SANITIZE} -fno-omit-frame-pointer -g)
    target_link_options(${target} PRIVATE -fsanitize=${PANVO_SANITIZE})
  endif()
endfunction()

function(_panvo_unity_build target)
  if(PANVO_UNITY)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    # A class of one source may have members of types that are internal to it, and a function a variable named like another source's constant.
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage$<SEMICOLON>-Wno-shadow$<SEMICOLON>-Wshadow=local>)
  endif()
endfunction()

# Uses the precompiled headers of libraries, programs or tests where they exist, see panvo_precompiled_headers.cmake.
function(_panvo_use_precompiled_headers target kind)
  set(headers panvo_headers_of_${kind})
  if(TARGET ${headers})
    target_precompile_headers(${target} REUSE_FROM ${headers})
    # GCC takes the code of precompiled headers for ours and then warns of reads and writes beyond std::string where there are none.
    target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
    # Macros that the headers test must be equal.
    target_compile_definitions(${target} PRIVATE $<TARGET_PROPERTY:${headers},COMPILE_DEFINITIONS>)
  endif()
endfunction()

# panvo_add_library(panvo_<name> SOURCES ... [LINK ...] [PRIVATE_LINK ...]): a shared library with the alias panvo::<name>;
# header-only without SOURCES.
function(panvo_add_library target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LINK;PRIVATE_LINK")
  string(REGEX REPLACE "^panvo_" "" short ${target})
  if(arg_SOURCES)
    add_library(${target} SHARED ${arg_SOURCES})
    target_include_directories(${target} PUBLIC
      $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    target_link_libraries(${target} PUBLIC ${arg_LINK} PRIVATE ${arg_PRIVATE_LINK})
    set_target_properties(${target} PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR})
    _panvo_compile_settings(${target})
    _panvo_unity_build(${target})
    _panvo_use_precompiled_headers(${target} libraries)
  else()
    add_library(${target} INTERFACE)
    target_include_directories(${target} INTERFACE
      $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
    target_link_libraries(${target} INTERFACE ${arg_LINK})
  endif()
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${short})
  add_library(panvo::${short} ALIAS ${target})
  set_property(DIRECTORY APPEND PROPERTY PANVO_EXPORTED ${target})
endfunction()

# panvo_add_fingerprint(panvo_<name> HEADERS ...): generates "panvo/<name>/fingerprint.hpp" with PANVO_<NAME>_FINGERPRINT. By comparing
# it, a binary detects that another one was compiled with different headers.
function(panvo_add_fingerprint target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "HEADERS")
  string(REGEX REPLACE "^panvo_" "" short ${target})
  string(TOUPPER ${target}_FINGERPRINT macro)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/fingerprint)
  set(header ${folder}/panvo/${short}/fingerprint.hpp)
  add_custom_command(
    OUTPUT ${folder}/stamp
    BYPRODUCTS ${header}
    COMMAND ${CMAKE_COMMAND} -DMACRO=${macro} "-DHEADERS=${arg_HEADERS}" -DOUTPUT=${header} -P ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/panvo_fingerprint.cmake
    COMMAND ${CMAKE_COMMAND} -E touch ${folder}/stamp
    DEPENDS ${arg_HEADERS} ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/panvo_fingerprint.cmake
    COMMENT "Computing the fingerprint of ${target}'s headers"
    VERBATIM)
  add_custom_target(${target}_fingerprint DEPENDS ${folder}/stamp)
  add_dependencies(${target} ${target}_fingerprint)
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${folder}>)
  install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/panvo/${short} COMPONENT libpanvo-dev)
endfunction()

# panvo_add_component(panvo_<name>_component SOURCES ... [LINK ...] [NO_INSTALL]): a plugin that the container loads by file name.
function(panvo_add_component target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "NO_INSTALL" "" "SOURCES;LINK")
  add_library(${target} MODULE ${arg_SOURCES})
  target_link_libraries(${target} PRIVATE panvo::runtime ${arg_LINK})
  set_target_properties(${target} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/panvo_plugins)
  _panvo_compile_settings(${target})
  _panvo_unity_build(${target})
  if(NOT arg_NO_INSTALL)
    install(TARGETS ${target} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/panvo)
    set_property(GLOBAL APPEND PROPERTY PANVO_PROGRAMS ${target})
  endif()
endfunction()

# Command-line tools, tests and Python modules run briefly: more optimisation would cost more compile time than it saves.
function(_panvo_optimise_little target)
  target_compile_options(${target} PRIVATE $<$<OR:$<CONFIG:Release>,$<CONFIG:>>:-O1>)
endfunction()

# panvo_add_executable(<name> SOURCES ... [LINK ...] [NO_INSTALL]): a program. `panvo bench` runs those named <name>_benchmark.
function(panvo_add_executable target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "NO_INSTALL" "" "SOURCES;LINK")
  add_executable(${target} ${arg_SOURCES})
  target_link_libraries(${target} PRIVATE ${arg_LINK})
  _panvo_compile_settings(${target})
  _panvo_unity_build(${target})
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/panvo_bin)
  if(target MATCHES "_benchmark$")
    set_property(GLOBAL APPEND PROPERTY PANVO_BENCHMARKS ${target})
  else()
    _panvo_use_precompiled_headers(${target} programs)
    _panvo_optimise_little(${target})
  endif()
  if(NOT arg_NO_INSTALL)
    install(TARGETS ${target} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
    set_property(GLOBAL APPEND PROPERTY PANVO_PROGRAMS ${target})
  endif()
endfunction()

# panvo_add_test(<name> SOURCES ... [LINK ...] [LABELS ...] [TIMEOUT seconds] [DEFINITIONS ...] [ENVIRONMENT ...]
# [ALONE] [APART]): each TEST() becomes a ctest. ALONE: do not run it in parallel with others. APART: do not compile its sources together,
# because they define the same names.
# Tests can include "panvo/test/...": temporary folders and recordings.
function(panvo_add_test target)
  if(NOT BUILD_TESTING)
    return()
  endif()
  cmake_parse_arguments(PARSE_ARGV 1 arg "ALONE;APART" "TIMEOUT" "SOURCES;LINK;LABELS;DEFINITIONS;ENVIRONMENT")
  find_package(GTest QUIET)
  if(NOT TARGET GTest::gmock)
    message(FATAL_ERROR "${target} needs GoogleTest with GoogleMock. Remedy: apt-get install libgmock-dev, or -DBUILD_TESTING=OFF")
  endif()
  include(GoogleTest)
  add_executable(${target} ${arg_SOURCES})
  target_link_libraries(${target} PRIVATE ${arg_LINK} panvo::test_headers GTest::gmock GTest::gtest_main)
  target_compile_definitions(${target} PRIVATE ${arg_DEFINITIONS})
  _panvo_compile_settings(${target})
  _panvo_use_precompiled_headers(${target} tests)
  if(NOT arg_APART)
    _panvo_unity_build(${target})
  endif()
  _panvo_optimise_little(${target})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 120)
  endif()
  if(CMAKE_CROSSCOMPILING)  # emulated
    math(EXPR arg_TIMEOUT "${arg_TIMEOUT} * 10")
  endif()
  set(properties TIMEOUT ${arg_TIMEOUT})
  if(arg_LABELS)
    list(APPEND properties LABELS ${arg_LABELS})
  endif()
  if(arg_ALONE)
    list(APPEND properties RUN_SERIAL TRUE)
  endif()
  if(arg_ENVIRONMENT)
    list(APPEND properties ENVIRONMENT ${arg_ENVIRONMENT})
  endif()
  gtest_discover_tests(${target} NO_PRETTY_VALUES DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60 PROPERTIES ${properties})
endfunction()

# panvo_add_python_module(panvo_<name> PACKAGE package FILES ... SOURCES ... [LINK ...]): the compiled part _core of a Python package, and its
# other files. Needs find_package(Python COMPONENTS Interpreter Development.Module) and pybind11. The package lies in panvo_python/ of the build
# folder, ready to import, and is installed where Debian packages (prefix /usr) or colcon (other prefixes) expect it.
function(panvo_add_python_module target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "PACKAGE" "FILES;SOURCES;LINK")
  set(folder ${CMAKE_BINARY_DIR}/panvo_python/${arg_PACKAGE})
  pybind11_add_module(${target} MODULE NO_EXTRAS ${arg_SOURCES})
  target_link_libraries(${target} PRIVATE ${arg_LINK})
  _panvo_compile_settings(${target})
  _panvo_unity_build(${target})
  _panvo_optimise_little(${target})  # it only converts; the algorithms are in libraries
  set_target_properties(${target} PROPERTIES OUTPUT_NAME _core LIBRARY_OUTPUT_DIRECTORY ${folder}
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  set(destination lib/python${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}/site-packages)
  if(CMAKE_INSTALL_PREFIX STREQUAL "/usr")
    set(destination lib/python3/dist-packages)
  endif()
  # The libraries lie in the prefix, or, in a wheel, beside the module.
  set_property(TARGET ${target} PROPERTY INSTALL_RPATH "$ORIGIN;$ORIGIN/../../../../${CMAKE_INSTALL_LIBDIR};$ORIGIN/../../../../lib")
  foreach(file IN LISTS arg_FILES)
    cmake_path(GET file FILENAME name)
    configure_file(${file} ${folder}/${name} COPYONLY)
  endforeach()
  install(TARGETS ${target} LIBRARY DESTINATION ${destination}/${arg_PACKAGE})
  install(FILES ${arg_FILES} DESTINATION ${destination}/${arg_PACKAGE})
endfunction()

# panvo_add_fuzzer(<name>_fuzzer SOURCES ... [LINK ...]): a libFuzzer program, only with PANVO_FUZZ.
# To run it: <name>_fuzzer -runs=1000000 CORPUS
function(panvo_add_fuzzer target)
  if(NOT PANVO_FUZZ)
    return()
  endif()
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LINK")
  add_executable(${target} ${arg_SOURCES})
  target_link_libraries(${target} PRIVATE ${arg_LINK} panvo::test_headers)
  _panvo_compile_settings(${target})
  target_link_options(${target} PRIVATE -fsanitize=fuzzer)
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/panvo_bin)
  set_property(GLOBAL APPEND PROPERTY PANVO_FUZZERS ${target})
endfunction()

# panvo_package(DEPENDENCIES <package> ...): installs headers, exports the libraries of panvo_add_library, and writes the package's config
# file. A dependency may have components: "OpenCV COMPONENTS core imgproc" as one quoted argument. INCLUDE: files next to the config file
# that it includes.
function(panvo_package)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "" "DEPENDENCIES;INCLUDE")
  set(destination ${CMAKE_INSTALL_DATADIR}/${PROJECT_NAME}/cmake)
  if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/include)
    install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT libpanvo-dev)
  endif()
  install(FILES package.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/${PROJECT_NAME} COMPONENT libpanvo-dev)
  get_property(targets DIRECTORY PROPERTY PANVO_EXPORTED)
  if(targets)
    set(finds "")
    foreach(dependency IN LISTS arg_DEPENDENCIES)
      string(APPEND finds "find_dependency(${dependency})\n")
    endforeach()
    set(includes "")
    foreach(file IN ITEMS ${PROJECT_NAME}-targets.cmake LISTS arg_INCLUDE)
      string(APPEND includes "include(\${CMAKE_CURRENT_LIST_DIR}/${file})\n")
    endforeach()
    get_property(installs_idl DIRECTORY PROPERTY PANVO_INSTALLS_IDL)
    if(installs_idl)  # for packages whose messages contain messages of this package
      string(APPEND includes "set_property(GLOBAL APPEND PROPERTY PANVO_IDL \${CMAKE_CURRENT_LIST_DIR}/../idl)\n")
    endif()
    file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/${PROJECT_NAME}-config.cmake "include(CMakeFindDependencyMacro)\n${finds}${includes}")
    write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/${PROJECT_NAME}-config-version.cmake COMPATIBILITY SameMajorVersion)
    install(TARGETS ${targets} EXPORT ${PROJECT_NAME}-targets
      LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} NAMELINK_COMPONENT libpanvo-dev ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
    install(EXPORT ${PROJECT_NAME}-targets NAMESPACE panvo:: DESTINATION ${destination} COMPONENT libpanvo-dev)
    install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${PROJECT_NAME}-config.cmake
      ${CMAKE_CURRENT_BINARY_DIR}/${PROJECT_NAME}-config-version.cmake DESTINATION ${destination} COMPONENT libpanvo-dev)
  endif()
endfunction()
