# panvo_find_fast_dds(): finds Fast DDS 3 (Debian 13) or 2.9 to 2.11 (Debian 12) and sets PANVO_FAST_DDS to its target.
macro(panvo_find_fast_dds)
  find_package(fastdds 3 QUIET)
  if(fastdds_FOUND)
    set(PANVO_FAST_DDS fastdds)
  else()
    find_package(fastcdr 1 REQUIRED)  # where a ROS 2 is sourced, CMake would prefer its later one
    find_package(fastrtps 2.9...<2.12 REQUIRED)
    set(PANVO_FAST_DDS fastrtps)
  endif()
endmacro()
