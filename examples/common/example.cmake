# Included by each example that draws: finds fxsdk, as part of its build or installed, and defines
# example_program(name source...).
if(NOT TARGET fxsdk::fxsdk)
    find_package(fxsdk 0.1 REQUIRED)
endif()
if(NOT TARGET fx_example_gl)
    add_subdirectory("${CMAKE_CURRENT_LIST_DIR}" common)
endif()

function(example_program name)
    add_executable(${name} ${ARGN})
    target_link_libraries(${name} PUBLIC fx_example_gl fxsdk::fxsdk)
    if(COMMAND fx_adopt) # in the tree of fxsdk
        fx_adopt(${name} 6)
    endif()
endfunction()
