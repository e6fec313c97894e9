# Toolchain of the build type arm64: Debian's cross compiler, the libraries unpacked by launch_scripts/lib/sysroot.sh, and qemu for the tests.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)

if(NOT PANVO_SYSROOT)
  cmake_path(SET PANVO_SYSROOT NORMALIZE ${CMAKE_CURRENT_LIST_DIR}/../../build/sysroot-arm64)
endif()
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES PANVO_SYSROOT)
if(NOT EXISTS ${PANVO_SYSROOT}/.panvo_packages)
  message(FATAL_ERROR "${PANVO_SYSROOT} does not hold the arm64 libraries: 'panvo build --arch arm64' unpacks them")
endif()
set(CMAKE_SYSROOT ${PANVO_SYSROOT})

# Programs of this machine; headers, libraries and packages of the other one.
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${PANVO_SYSROOT})
set(ENV{PKG_CONFIG_LIBDIR} ${PANVO_SYSROOT}/usr/lib/aarch64-linux-gnu/pkgconfig:${PANVO_SYSROOT}/usr/share/pkgconfig)

# Libraries that libraries of the distribution need are not on the linker's command line.
string(APPEND CMAKE_EXE_LINKER_FLAGS_INIT " -Wl,-rpath-link,${PANVO_SYSROOT}/usr/lib/aarch64-linux-gnu")
string(APPEND CMAKE_SHARED_LINKER_FLAGS_INIT " -Wl,-rpath-link,${PANVO_SYSROOT}/usr/lib/aarch64-linux-gnu")
string(APPEND CMAKE_MODULE_LINKER_FLAGS_INIT " -Wl,-rpath-link,${PANVO_SYSROOT}/usr/lib/aarch64-linux-gnu")

# The build folder may be copied to another place on the robot.
set(CMAKE_BUILD_RPATH_USE_ORIGIN ON)

find_program(PANVO_QEMU NAMES qemu-aarch64 qemu-aarch64-static)
mark_as_advanced(PANVO_QEMU)
if(PANVO_QEMU)
  set(CMAKE_CROSSCOMPILING_EMULATOR ${PANVO_QEMU};-L;${PANVO_SYSROOT})
endif()
