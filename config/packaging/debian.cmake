# Debian packages panvo, panvo-simulation and libpanvo-dev by CPack, from a build configured for /usr (preset "package").
set(description_panvo "visual odometry with drift correction from recognised places
Programs, components and system files: stereo odometry, place recognition and
localization from stereo pairs and panoramas, over DDS, in the conventions of
ROS 2.")
set(description_panvo-simulation "simulated cameras for panvo
Renders drives through a simulated campus, with ground truth, as data sets or
live cameras.")
set(description_libpanvo-dev "development files of panvo
Headers, CMake packages, IDL files and the generator of message classes, for
components of one's own.")

set(version ${PROJECT_VERSION})
set(same_version "(= ${version})")
set(section_panvo science)
set(section_panvo-simulation science)
set(section_libpanvo-dev libdevel)
set(depends_panvo "python3, systemd-standalone-sysusers | systemd-sysusers")
set(depends_panvo-simulation "panvo ${same_version}")
set(depends_libpanvo-dev "panvo ${same_version}, panvo-simulation ${same_version}, cmake, libceres-dev, libcli11-dev, libeigen3-dev, \
libfmt-dev, libopencv-dev, libsqlite3-dev, libspdlog-dev, python3")
set(recommends_panvo "gnuplot-nox, python3-numpy")
set(recommends_libpanvo-dev "libgmock-dev")  # for the tests of `panvo new component`
set(suggests_panvo "openssl, panvo-simulation")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME panvo)
set(CPACK_PACKAGE_VENDOR panvo)
set(CPACK_PACKAGE_VERSION ${version})
set(CPACK_PACKAGE_CONTACT "panvo developers <maintainers@panvo.dev>")
set(CPACK_COMPONENTS_ALL panvo panvo-simulation libpanvo-dev)
set(CPACK_SET_DESTDIR ON)  # for the files in /etc
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# Where dpkg-shlibdeps finds panvo's own libraries.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${package_folders})
list(TRANSFORM CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS PREPEND ${CMAKE_BINARY_DIR}/)
list(APPEND CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR}/panvo_plugins)
set(CPACK_DEBIAN_PANVO_PACKAGE_CONTROL_EXTRA conffiles postinst prerm postrm triggers)
list(TRANSFORM CPACK_DEBIAN_PANVO_PACKAGE_CONTROL_EXTRA PREPEND ${CMAKE_CURRENT_LIST_DIR}/)
set(CPACK_DEBIAN_PANVO-SIMULATION_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_LIST_DIR}/triggers)

# The changelog in Debian's format, one entry per release of CHANGELOG.md.
set(changelog "")
file(STRINGS CHANGELOG.md releases REGEX "^## \\[[0-9]")
foreach(release IN LISTS releases)
  string(REGEX MATCH "\\[(.*)\\] - (.*)" _ ${release})
  execute_process(COMMAND ${CMAKE_COMMAND} -E env LC_ALL=C date --utc --rfc-email --date=${CMAKE_MATCH_2} OUTPUT_VARIABLE date COMMAND_ERROR_IS_FATAL ANY)
  string(APPEND changelog "panvo (${CMAKE_MATCH_1}) stable; urgency=medium\n\n  * Release ${CMAKE_MATCH_1}; see CHANGELOG.md of the sources.\n\n"
    " -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
endforeach()
set(documents ${CMAKE_CURRENT_BINARY_DIR}/debian)
file(WRITE ${documents}/changelog "${changelog}")
execute_process(COMMAND gzip --force --best --no-name ${documents}/changelog COMMAND_ERROR_IS_FATAL ANY)

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  set(CPACK_COMPONENT_${upper}_DESCRIPTION ${description_${component}})
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${component})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section_${component}})
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS ${depends_${component}})
  set(CPACK_DEBIAN_${upper}_PACKAGE_RECOMMENDS ${recommends_${component}})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SUGGESTS ${suggests_${component}})
  set(CPACK_DEBIAN_${upper}_PACKAGE_SHLIBDEPS ON)
  install(FILES ${documents}/changelog.gz ${CMAKE_CURRENT_LIST_DIR}/copyright DESTINATION share/doc/${component} COMPONENT ${component})
endforeach()
foreach(component IN ITEMS panvo panvo-simulation)
  install(FILES ${CMAKE_CURRENT_LIST_DIR}/lintian-overrides DESTINATION share/lintian/overrides RENAME ${component} COMPONENT ${component})
endforeach()
include(CPack)
