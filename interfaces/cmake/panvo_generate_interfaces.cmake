# Included by find_package(panvo_interfaces).
include_guard(DIRECTORY)

# panvo_generate_interfaces(<package> FILE... [RULES header...] [SOURCES file...] [NO_INSTALL]): builds the message library panvo::<package>
# from msg/<Name>.msg, srv/<Name>.srv (ROS 2's notations), msg/<Name>.idl and srv/<Name>.idl. C++ code includes "<package>/msg/<Name>.h".
# Programs that do not link the library find it by package name at run time: panvo topic echo, the recorder, the player and the bag tools.
# Packages whose messages are contained are linked automatically; for those outside panvo, call find_package() before.
# RULES: headers that declare std::optional<std::string> problem_of(const <package>::msg::<Name>&), SOURCES: their definitions; see
# README.md.
# panvo_package() installs and exports the library.
function(panvo_generate_interfaces package)
  cmake_parse_arguments(PARSE_ARGV 1 arg "NO_INSTALL" "" "RULES;SOURCES")
  if(NOT COMMAND panvo_add_library)
    message(FATAL_ERROR "panvo_generate_interfaces(${package}): call find_package(panvo_build REQUIRED) before")
  endif()
  if(NOT arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "panvo_generate_interfaces(${package}): give the definition files: msg/<Name>.msg, srv/<Name>.srv or .idl")
  endif()
  if(NOT package MATCHES "^[a-z][a-z0-9_]*$")
    message(FATAL_ERROR "panvo_generate_interfaces(${package}): a package name starts with a letter and has only lower-case letters, digits and '_'")
  endif()
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  set(files "")
  foreach(file IN LISTS arg_UNPARSED_ARGUMENTS)
    cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    list(APPEND files ${file})
  endforeach()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${files})

  cmake_path(GET CMAKE_CURRENT_FUNCTION_LIST_DIR PARENT_PATH home)
  set(generated ${CMAKE_CURRENT_BINARY_DIR}/messages/${package})
  get_property(known GLOBAL PROPERTY PANVO_IDL)
  list(REMOVE_DUPLICATES known)
  set(known_files "")  # hash and layout of a message depend on those it contains
  foreach(folder IN LISTS known)
    file(GLOB_RECURSE found ${folder}/*.idl)
    list(APPEND known_files ${found})
  endforeach()
  list(TRANSFORM known PREPEND "--known=")
  set(generate ${Python3_EXECUTABLE} ${home}/tools/generate.py --package ${package} ${known} --output ${generated})
  execute_process(COMMAND ${generate} --prepare ${files} OUTPUT_VARIABLE prepared ERROR_VARIABLE problem RESULT_VARIABLE status
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_STRIP_TRAILING_WHITESPACE)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "panvo_generate_interfaces(${package}): ${problem}")
  endif()
  # The output has two lines, both lists: the packages needed, and the names of the generated files.
  string(REGEX MATCH "^([^\n]*)\n([^\n]*)$" _ "${prepared}")
  set(needed ${CMAKE_MATCH_1})
  set(names ${CMAKE_MATCH_2})
  list(TRANSFORM names REPLACE "(.+)" "${generated}/\\1.h" OUTPUT_VARIABLE headers)
  set(linked "")
  foreach(other IN LISTS needed)
    if(TARGET panvo::${other})  # otherwise the package is in the library panvo_interfaces
      list(APPEND linked panvo::${other})
    endif()
  endforeach()

  set(rules ${arg_RULES})
  list(TRANSFORM rules PREPEND "--rules=")
  file(GLOB generator CONFIGURE_DEPENDS ${home}/tools/*.py)
  # make and ninja compare the stamp file. Generated files with unchanged content keep their time stamp and are not recompiled.
  add_custom_command(
    OUTPUT ${generated}/stamp
    BYPRODUCTS ${generated}/message_table.cpp ${headers}
    COMMAND ${generate} ${rules} ${files}
    COMMAND ${CMAKE_COMMAND} -E touch ${generated}/stamp
    DEPENDS ${files} ${known_files} ${generator}
    COMMENT "Generating message classes of ${package}"
    VERBATIM)
  add_custom_target(${package}_generate DEPENDS ${generated}/stamp)

  panvo_add_library(${package} SOURCES ${generated}/message_table.cpp ${arg_SOURCES} LINK panvo::interfaces ${linked})
  add_dependencies(${package} ${package}_generate)
  target_include_directories(${package} PUBLIC $<BUILD_INTERFACE:${generated}>)
  target_link_options(${package} PRIVATE -Wl,-z,nodelete)  # references to its types stay valid
  if(NOT PANVO_SANITIZE AND NOT PANVO_FUZZ)  # sanitizers leave symbols for the program to define
    target_link_options(${package} PRIVATE -Wl,-z,defs)
  endif()
  set_target_properties(${package} PROPERTIES
    OUTPUT_NAME ${package}__panvo
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/panvo_plugins
    UNITY_BUILD OFF)
  set_property(TARGET ${package} PROPERTY VERSION)  # loaded by name at run time
  set_property(TARGET ${package} PROPERTY SOVERSION)
  set_property(GLOBAL APPEND PROPERTY PANVO_IDL ${generated}/idl)
  if(arg_NO_INSTALL)
    return()
  endif()
  install(DIRECTORY ${generated}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT libpanvo-dev FILES_MATCHING PATTERN "*.h" PATTERN "idl" EXCLUDE)
  install(DIRECTORY ${generated}/idl/ DESTINATION ${CMAKE_INSTALL_DATADIR}/${PROJECT_NAME}/idl COMPONENT libpanvo-dev)
  set_property(DIRECTORY PROPERTY PANVO_INSTALLS_IDL ON)
endfunction()
