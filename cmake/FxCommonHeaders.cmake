# Headers of the standard library and GLM that most sources include are compiled once.
# Sources name what they use all the same: builds without precompiled headers, as those of scripts/check-all, show it.
option(FXSDK_PRECOMPILE_HEADERS "Read headers that most sources include once" ON)
set(FX_COMMON_HEADERS <algorithm> <array> <atomic> <cmath> <cstdint> <cstring> <functional> <limits> <map> <memory> <memory_resource>
    <mutex> <numbers> <numeric> <optional> <span> <string> <string_view> <utility> <vector> <glm/glm.hpp> <glm/gtc/quaternion.hpp>)

# Sources of tests, of commands of `fx` and of the editor are compiled several at once, so that headers are read and
# templates are compiled once for all of them. Those of libraries are not: what is measured and installed must not depend
# on which functions the compiler happens to see together.
option(FXSDK_UNITY_BUILD "Compile several sources of a test or command at once" ON)

# Compiles the sources of `target` up to 12 at once, but for those named behind it, kernels of Highway, which are read
# once for each instruction set, and replacements of operator new, which compilers must not see beside its uses.
function(fx_compile_at_once target)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 12)
    get_target_property(sources ${target} SOURCES)
    foreach(source IN LISTS sources)
        cmake_path(ABSOLUTE_PATH source OUTPUT_VARIABLE path)
        set(special "")
        if(EXISTS "${path}")
            file(STRINGS "${path}" special LIMIT_COUNT 1 REGEX "hwy/foreach_target\\.h|^void\\* operator new")
        endif()
        if(special OR source IN_LIST ARGN)
            set_source_files_properties("${source}" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
        endif()
    endforeach()
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU") # sources are now included, where GCC expects no unnamed namespace
        target_compile_options(${target} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-Wno-subobject-linkage>)
    endif()
endfunction()

# Tests are run once for each time that they are compiled: what they test is optimized fully, they themselves less.
set(FX_TEST_OPTIMIZATION $<$<CONFIG:Release>:-O1>)

# Compiles `headers` for targets that are compiled as `target` is: GCC tells code of libraries from code of programs.
function(fx_precompile target position_independence)
    set(source "${PROJECT_BINARY_DIR}/${target}.cpp")
    file(CONFIGURE OUTPUT "${source}" CONTENT "")
    add_library(${target} OBJECT "${source}")
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
    target_compile_options(${target} PRIVATE ${position_independence})
    target_link_libraries(${target} PRIVATE fx_flags glm::glm)
    target_precompile_headers(${target} PRIVATE ${ARGN})
endfunction()

if(FXSDK_PRECOMPILE_HEADERS)
    find_package(glm REQUIRED)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        # False for "literal" + std::string, and not known to be in a header of the system once it is precompiled.
        target_compile_options(fx_flags INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wno-stringop-overflow> $<$<COMPILE_LANGUAGE:CXX>:-Wno-array-bounds>)
    endif()
    fx_precompile(fx_library_headers -fPIC ${FX_COMMON_HEADERS})
    if(FXSDK_BUILD_FUZZERS)
        target_compile_options(fx_library_headers PRIVATE -fsanitize=fuzzer-no-link)
    endif()
    if(FXSDK_BUILD_TESTS)
        find_package(GTest REQUIRED)
        fx_precompile(fx_test_headers "-fPIE;${FX_TEST_OPTIMIZATION}" ${FX_COMMON_HEADERS} <gtest/gtest.h>)
        target_link_libraries(fx_test_headers PRIVATE GTest::gtest)
    endif()
endif()
