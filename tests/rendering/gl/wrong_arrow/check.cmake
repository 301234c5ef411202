# Configures the project beside this file with right and wrong arrows and looks at what CMake says.
function(expect folder layer wanted)
    file(REMOVE_RECURSE "${FX_SCRATCH}")
    execute_process(COMMAND ${CMAKE_COMMAND} -S "${CMAKE_CURRENT_LIST_DIR}" -B "${FX_SCRATCH}"
                            "-DFX_ROOT=${FX_ROOT}" -DFX_FROM=${folder} -DFX_FROM_LAYER=${layer}
        RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
    if(wanted STREQUAL "accepted" AND failed)
        message(FATAL_ERROR "${folder}, layer ${layer}: a right arrow was refused\n${output}")
    endif()
    if(wanted STREQUAL "refused" AND (NOT failed OR NOT output MATCHES "fx_arrow \\(layer ${layer}\\) must not depend on"))
        message(FATAL_ERROR "${folder}, layer ${layer}: a wrong arrow was not refused\n${output}")
    endif()
endfunction()

expect(rendering 2 accepted)  # beside each other in one folder
expect(simulation 3 accepted) # downwards
expect(simulation 2 refused)  # simulation and rendering meet
expect(rendering 1 refused)   # upwards
