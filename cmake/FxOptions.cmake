# Options of the build. Every default works offline; tests, examples and tools are only built when fxsdk is the top project.
option(FXSDK_BUILD_TESTS "Build the tests" ${PROJECT_IS_TOP_LEVEL})
option(FXSDK_BUILD_EXAMPLES "Build the examples" ${PROJECT_IS_TOP_LEVEL})
option(FXSDK_BUILD_TOOLS "Build the fx command and the modules only it needs (EXR, PNG, EGL, GLFW)" ${PROJECT_IS_TOP_LEVEL})
option(FXSDK_BUILD_STATIC "Build libfxsdk.a too" ${PROJECT_IS_TOP_LEVEL})
option(FXSDK_PYTHON "Build the Python package, where pycparser is installed" ${PROJECT_IS_TOP_LEVEL})
option(FXSDK_GPU_PARTICLES "Compute particles of emitters that ask for it on the GPU" ON)
option(FXSDK_VDB "Read and write OpenVDB files (fx import, fx export) where OpenVDB is installed" ON)
option(FXSDK_WERROR "Treat warnings as errors" ${PROJECT_IS_TOP_LEVEL})
set(FXSDK_SANITIZE "" CACHE STRING "Sanitizers to build with, as given to -fsanitize= (address,undefined or thread)")
option(FXSDK_BUILD_FUZZERS "Build tests/fuzz with libFuzzer, which only Clang has; otherwise they replay their corpora" OFF)
option(FXSDK_FEW_INSTRUCTION_SETS "Compile kernels for scalar code and AVX2 only, in half the time; for builds that only run tests"
    ${FXSDK_BUILD_FUZZERS})

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_C_STANDARD 11)
set(CMAKE_C_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_C_VISIBILITY_PRESET hidden)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib")
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/lib")

find_program(FXSDK_CCACHE ccache) # repeated builds of the same text cost nothing
if(FXSDK_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_C_COMPILER_LAUNCHER "${FXSDK_CCACHE}")
    set(CMAKE_CXX_COMPILER_LAUNCHER "${FXSDK_CCACHE}")
endif()

# Flags of our own code. Consumers never inherit them.
add_library(fx_flags INTERFACE)
target_compile_options(fx_flags INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict> # GCC 12 sees overlaps in "literal" + std::string that are not there
    $<$<COMPILE_LANGUAGE:CXX>:-Wnon-virtual-dtor>
    $<$<COMPILE_LANGUAGE:CXX>:-Woverloaded-virtual>
    -ffp-contract=off # the same bits with and without FMA hardware; see docs/conventions.md
    $<$<BOOL:${FXSDK_WERROR}>:-Werror>)
target_compile_definitions(fx_flags INTERFACE $<$<CONFIG:Debug>:_GLIBCXX_ASSERTIONS>) # indices are checked
if(FXSDK_SANITIZE)
    target_compile_options(fx_flags INTERFACE -fsanitize=${FXSDK_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all
        $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>) # false in std::regex and std::function once instrumented
    target_compile_definitions(fx_flags INTERFACE _GLIBCXX_ASSERTIONS)
    target_link_options(fx_flags INTERFACE -fsanitize=${FXSDK_SANITIZE})
endif()
if(FXSDK_BUILD_FUZZERS AND NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "FXSDK_BUILD_FUZZERS needs Clang: add -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++")
endif()
# For kernels of Highway, which are compiled once for every instruction set. SSSE3 is skipped: processors without SSE4
# take the scalar code.
set(FX_KERNEL_DEFINITIONS HWY_DISABLED_TARGETS=HWY_SSSE3)
if(FXSDK_FEW_INSTRUCTION_SETS)
    set(FX_KERNEL_DEFINITIONS "")
    target_compile_definitions(fx_flags INTERFACE "HWY_DISABLED_TARGETS=(HWY_SSSE3|HWY_SSE4|HWY_AVX3|HWY_AVX3_DL)")
endif()

set(FX_TEST_TIMEOUT 1800) # [s] ends a test that hangs; on a machine that is busy otherwise none comes near it
if(FXSDK_SANITIZE)
    set(FX_TEST_TIMEOUT 7200)
endif()
