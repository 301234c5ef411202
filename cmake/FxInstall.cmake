# What is installed beside the library and its headers (fxsdk/api/CMakeLists.txt), all in the component sdk: the license, the
# presets of the library with the files that they name, and, where tools are built, the fx command and the JSON schemas
# by which editors complete presets and scenes.
include(GNUInstallDirs)
set(FX_DATA_DIR "${CMAKE_INSTALL_DATADIR}/fxsdk")

install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT sdk)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/fxsdk/presets/library/" "${PROJECT_BINARY_DIR}/fxsdk/presets/library/"
    DESTINATION "${FX_DATA_DIR}/presets" COMPONENT sdk
    FILES_MATCHING PATTERN "*.fx.json" PATTERN "*.obj" PATTERN "*.mtl" PATTERN "*.png")

if(TARGET fx)
    set(schemas "")
    foreach(kind preset scene)
        set(file "${PROJECT_BINARY_DIR}/schema/${kind}.schema.json")
        list(APPEND schemas "${file}")
        add_custom_command(OUTPUT "${file}"
            COMMAND ${CMAKE_COMMAND} -E make_directory "${PROJECT_BINARY_DIR}/schema"
            COMMAND fx parameters --json-schema ${kind} > "${file}"
            DEPENDS fx COMMENT "Writing the schema of ${kind} files" VERBATIM)
    endforeach()
    add_custom_target(fx_schemas ALL DEPENDS ${schemas})
    # Who has built the library alone installs it alone.
    install(TARGETS fx RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT sdk OPTIONAL)
    install(FILES ${schemas} DESTINATION "${FX_DATA_DIR}/schema" COMPONENT sdk OPTIONAL)
endif()
