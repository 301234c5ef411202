# Included by each host: finds fxsdk, as part of its build or installed, and defines
# host_program(name SOURCES source... LIBS library...).
if(NOT TARGET fxsdk::fxsdk)
    find_package(fxsdk 0.1 REQUIRED)
endif()
if(NOT TARGET host_common)
    add_subdirectory("${CMAKE_CURRENT_LIST_DIR}" common)
endif()

function(host_program name)
    cmake_parse_arguments(ARG "" "" "SOURCES;LIBS" ${ARGN})
    add_executable(${name} ${ARG_SOURCES})
    target_link_libraries(${name} PRIVATE host_common ${ARG_LIBS} $<TARGET_NAME_IF_EXISTS:fx_flags>)
endfunction()
