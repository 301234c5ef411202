# fx_module(NAME name LAYER n SOURCES ... [ALONE source ...] [DEPENDS module ...] [LIBS library ...])
#
# Defines the static library fx_<name>. DEPENDS names other fx_ modules without their prefix, LIBS outside libraries.
# In folders that set FX_PROGRAM_SOURCES, sources are compiled up to 12 at once (see FxCommonHeaders.cmake), those behind
# ALONE one by one.
# Configuring fails when an arrow points upwards, sideways between two top folders, or when simulation and
# rendering meet: docs/architecture.md draws the arrows that are allowed.

define_property(TARGET PROPERTY FX_LAYER BRIEF_DOCS "Layer of an fxsdk module")
define_property(TARGET PROPERTY FX_FOLDER BRIEF_DOCS "Top folder of an fxsdk module")

function(fx_top_folder out)
    file(RELATIVE_PATH path "${PROJECT_SOURCE_DIR}" "${CMAKE_CURRENT_SOURCE_DIR}")
    string(REGEX REPLACE "/.*" "" folder "${path}")
    set(${out} "${folder}" PARENT_SCOPE)
endfunction()

# Stops the configuration when `target` may not depend on `dependency`.
function(fx_check_arrow target dependency)
    get_target_property(layer ${target} FX_LAYER)
    get_target_property(folder ${target} FX_FOLDER)
    get_target_property(dep_layer ${dependency} FX_LAYER)
    get_target_property(dep_folder ${dependency} FX_FOLDER)
    if(dep_layer LESS layer OR (dep_layer EQUAL layer AND dep_folder STREQUAL folder))
        return()
    endif()
    message(FATAL_ERROR "${target} (layer ${layer}) must not depend on ${dependency} (layer ${dep_layer}); "
                        "see docs/architecture.md")
endfunction()

# Gives `target` its layer, our flags and its checked dependencies.
function(fx_adopt target layer)
    cmake_parse_arguments(ARG "" "" "DEPENDS;LIBS" ${ARGN})
    fx_top_folder(folder)
    set_target_properties(${target} PROPERTIES FX_LAYER ${layer} FX_FOLDER "${folder}")
    foreach(name IN LISTS ARG_DEPENDS)
        if(NOT TARGET fx_${name})
            message(FATAL_ERROR "${target} depends on fx_${name}, which no CMakeLists.txt above it defines")
        endif()
        fx_check_arrow(${target} fx_${name})
        target_link_libraries(${target} PUBLIC fx_${name})
    endforeach()
    target_link_libraries(${target} PUBLIC ${ARG_LIBS} PRIVATE $<BUILD_INTERFACE:fx_flags>)
endfunction()

# Lets libFuzzer count which branches of `target` an input takes. Kernels of Highway are left out: their branches are
# loops over particles, and counters double the time that Clang needs for them.
function(fx_count_branches target)
    target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link)
    foreach(source IN LISTS ARGN)
        cmake_path(ABSOLUTE_PATH source OUTPUT_VARIABLE path)
        if(EXISTS "${path}")
            file(STRINGS "${path}" kernel LIMIT_COUNT 1 REGEX "hwy/foreach_target\\.h")
            if(kernel)
                set_source_files_properties("${source}" PROPERTIES COMPILE_OPTIONS -fno-sanitize=fuzzer-no-link SKIP_PRECOMPILE_HEADERS ON)
            endif()
        endif()
    endforeach()
endfunction()

function(fx_module)
    cmake_parse_arguments(ARG "" "NAME;LAYER" "SOURCES;ALONE;DEPENDS;LIBS" ${ARGN})
    add_library(fx_${ARG_NAME} STATIC ${ARG_SOURCES} ${ARG_ALONE})
    if(FX_PROGRAM_SOURCES AND FXSDK_UNITY_BUILD)
        fx_compile_at_once(fx_${ARG_NAME} ${ARG_ALONE})
    endif()
    if(FXSDK_BUILD_FUZZERS)
        fx_count_branches(fx_${ARG_NAME} ${ARG_SOURCES} ${ARG_ALONE})
    endif()
    target_include_directories(fx_${ARG_NAME} PUBLIC "${PROJECT_SOURCE_DIR}")
    fx_adopt(fx_${ARG_NAME} ${ARG_LAYER} DEPENDS ${ARG_DEPENDS} LIBS ${ARG_LIBS})
    if(TARGET fx_library_headers)
        target_precompile_headers(fx_${ARG_NAME} REUSE_FROM fx_library_headers)
    endif()
endfunction()
