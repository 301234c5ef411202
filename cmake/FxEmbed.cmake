# fx_embed_texts(TARGET target NAMESPACE ns HEADER file.h BASE folder FILES relative/path ...
#                [MADE_IN folder MADE file ...])
#
# Compiles files, texts or not, into `target` as a table: HEADER (found in the build tree as "embedded/<file.h>") declares
# std::span<const fx::base::EmbeddedText> ns::texts(). Names are the paths as given. MADE are files that the build makes in
# the folder MADE_IN; they follow the others.
set(FX_EMBED_SCRIPT "${CMAKE_CURRENT_LIST_DIR}/embed_texts.cmake")

function(fx_embed_texts)
    cmake_parse_arguments(ARG "" "TARGET;NAMESPACE;HEADER;BASE;MADE_IN" "FILES;MADE" ${ARGN})
    set(folder "${CMAKE_CURRENT_BINARY_DIR}/embedded_include")
    set(header "${folder}/embedded/${ARG_HEADER}")
    string(REGEX REPLACE "\\.h$" ".cpp" source "${header}")
    set(inputs "")
    foreach(file IN LISTS ARG_FILES)
        list(APPEND inputs "${ARG_BASE}/${file}")
    endforeach()
    foreach(file IN LISTS ARG_MADE)
        list(APPEND inputs "${ARG_MADE_IN}/${file}")
    endforeach()
    add_custom_command(OUTPUT "${header}" "${source}"
        COMMAND ${CMAKE_COMMAND} "-DHEADER=${header}" "-DSOURCE=${source}" "-DNAMESPACE=${ARG_NAMESPACE}"
                "-DBASE=${ARG_BASE}" "-DFILES=${ARG_FILES}" "-DMADE_IN=${ARG_MADE_IN}" "-DMADE=${ARG_MADE}"
                -P "${FX_EMBED_SCRIPT}"
        DEPENDS ${inputs} "${FX_EMBED_SCRIPT}"
        COMMENT "Embedding ${ARG_HEADER}" VERBATIM)
    # Texts may be longer than the 65536 characters that the standard asks of compilers; Clang warns of it.
    set_source_files_properties("${source}" PROPERTIES COMPILE_OPTIONS $<$<CXX_COMPILER_ID:Clang>:-Wno-overlength-strings>)
    target_sources(${ARG_TARGET} PRIVATE "${source}" "${header}")
    target_include_directories(${ARG_TARGET} PRIVATE "${folder}")
endfunction()
