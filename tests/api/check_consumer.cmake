# Run by CTest with BUILD, SOURCE, WORK, CONFIG and HAS_FX: installs the package, looks what there is, then configures,
# builds and runs a project that finds it there.
cmake_minimum_required(VERSION 3.25)

file(REMOVE_RECURSE "${WORK}")
set(prefix "${WORK}/prefix")
execute_process(COMMAND ${CMAKE_COMMAND} --install "${BUILD}" --prefix "${prefix}" --component sdk --config "${CONFIG}"
    COMMAND_ERROR_IS_FATAL ANY)
function(require_file name)
    if(NOT EXISTS "${prefix}/${name}")
        message(FATAL_ERROR "${name} is not installed")
    endif()
endfunction()

require_file(share/doc/fxsdk/LICENSE)
file(GLOB sources RELATIVE "${PRESETS}" "${PRESETS}/*.fx.json")
if(NOT sources)
    message(FATAL_ERROR "${PRESETS} has no presets")
endif()
foreach(name IN LISTS sources)
    require_file("share/fxsdk/presets/${name}")
endforeach()
foreach(name smoke.png spark.png debris-chunk.obj stage-yard.obj) # made while building, and not
    require_file("share/fxsdk/presets/${name}")
endforeach()

# The command works from where it is installed, and its schemas and presets are whole.
if(HAS_FX)
    foreach(kind preset scene)
        require_file("share/fxsdk/schema/${kind}.schema.json")
        file(READ "${prefix}/share/fxsdk/schema/${kind}.schema.json" schema)
        string(JSON members LENGTH "${schema}" properties)
    endforeach()
    file(GLOB presets "${prefix}/share/fxsdk/presets/*.fx.json")
    execute_process(COMMAND "${prefix}/bin/fx" validate ${presets} COMMAND_ERROR_IS_FATAL ANY)
    execute_process(COMMAND "${prefix}/bin/fx" render library:campfire -o "${WORK}/campfire.png" --size 48x32 --time 0.1
        COMMAND_ERROR_IS_FATAL ANY)
endif()

execute_process(COMMAND ${CMAKE_COMMAND} -S "${SOURCE}" -B "${WORK}/build" "-DCMAKE_PREFIX_PATH=${prefix}"
    COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build "${WORK}/build" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${WORK}/build/consumer" COMMAND_ERROR_IS_FATAL ANY)
