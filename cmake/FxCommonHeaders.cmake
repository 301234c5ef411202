# Headers of the standard library and GLM that most sources include are compiled once.
# Sources name what they use all the same: builds without precompiled headers, as those of scripts/check-all, show it.
option(FXSDK_PRECOMPILE_HEADERS "Read headers that most sources include once" ON)
set(FX_COMMON_HEADERS <algorithm> <array> <atomic> <cmath> <cstdint> <cstring> <functional> <limits> <map> <memory> <memory_resource>
    <mutex> <numbers> <numeric> <optional> <span> <string> <string_view> <utility> <vector> <glm/glm.hpp> <glm/gtc/quaternion.hpp>)

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
