# fx_embed_texts(TARGET target NAMESPACE ns HEADER file.h BASE folder FILES relative/path ...)
#
# Compiles text files into `target` as a table: HEADER (found in the build tree as "embedded/<file.h>") declares
# std::span<const fx::base::EmbeddedText> ns::texts(). Names are the paths as given.
set(FX_EMBED_SCRIPT "${CMAKE_CURRENT_LIST_DIR}/embed_texts.cmake")

function(fx_embed_texts)
    cmake_parse_arguments(ARG "" "TARGET;NAMESPACE;HEADER;BASE" "FILES" ${ARGN})
    set(folder "${CMAKE_CURRENT_BINARY_DIR}/embedded_include")
    set(header "${folder}/embedded/${ARG_HEADER}")
    string(REGEX REPLACE "\\.h$" ".cpp" source "${header}")
    set(inputs "")
    foreach(file IN LISTS ARG_FILES)
        list(APPEND inputs "${ARG_BASE}/${file}")
    endforeach()
    add_custom_command(OUTPUT "${header}" "${source}"
        COMMAND ${CMAKE_COMMAND} "-DHEADER=${header}" "-DSOURCE=${source}" "-DNAMESPACE=${ARG_NAMESPACE}"
                "-DBASE=${ARG_BASE}" "-DFILES=${ARG_FILES}" -P "${FX_EMBED_SCRIPT}"
        DEPENDS ${inputs} "${FX_EMBED_SCRIPT}"
        COMMENT "Embedding ${ARG_HEADER}" VERBATIM)
    target_sources(${ARG_TARGET} PRIVATE "${source}" "${header}")
    target_include_directories(${ARG_TARGET} PRIVATE "${folder}")
endfunction()
