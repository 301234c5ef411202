# What is installed, in six components, each of which is a Debian package too (cmake/FxPackages.cmake):
#   runtime  the shared library, and the license
#   dev      headers, static library, packages of CMake and pkg-config, description of the API
#   tools    the fx command, the JSON schemas by which editors complete presets and scenes, and the presets of the library
#            with the files that they name
#   editor   the effect editor for games: sources of the panels, which a game compiles with its own ImGui, the headers that they
#            include, and the library of what knows nothing of ImGui
#   doc      README, docs, and the examples with their scenes
#   python   the Python package (fxsdk/python/CMakeLists.txt)
# OPTIONAL: after building the library alone, what exists is installed.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(FX_DATA_DIR "${CMAKE_INSTALL_DATADIR}/fxsdk")
set(FX_PACKAGE_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/fxsdk")

# The installed files may be moved: libraries are found beside fx and beside each other.
set_target_properties(fxsdk PROPERTIES INSTALL_RPATH "$ORIGIN")
target_link_options(fxsdk PRIVATE -Wl,--disable-new-dtags)
install(TARGETS fxsdk EXPORT fxsdkTargets
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT runtime NAMELINK_COMPONENT dev)
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT runtime)

install(DIRECTORY "${PROJECT_SOURCE_DIR}/fxsdk/include/fxsdk" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT dev
    FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp")
if(TARGET fxsdk_static)
    install(FILES "$<TARGET_FILE:fxsdk_static>" DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dev)
endif()
if(TARGET fx_livelink)
    install(FILES "$<TARGET_FILE:fx_livelink>" DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dev OPTIONAL)
    install(FILES "${PROJECT_SOURCE_DIR}/fxsdk/livelink/include/fxsdk/fx_livelink.h"
        DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/fxsdk" COMPONENT dev)
endif()
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/fxsdkConfig.cmake.in" "${PROJECT_BINARY_DIR}/fxsdkConfig.cmake"
    INSTALL_DESTINATION "${FX_PACKAGE_DIR}" PATH_VARS CMAKE_INSTALL_LIBDIR CMAKE_INSTALL_INCLUDEDIR FX_DATA_DIR)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/fxsdkConfigVersion.cmake" COMPATIBILITY SameMajorVersion)
install(EXPORT fxsdkTargets NAMESPACE fxsdk:: DESTINATION "${FX_PACKAGE_DIR}" COMPONENT dev)
install(FILES "${PROJECT_BINARY_DIR}/fxsdkConfig.cmake" "${PROJECT_BINARY_DIR}/fxsdkConfigVersion.cmake"
    DESTINATION "${FX_PACKAGE_DIR}" COMPONENT dev)
string(REGEX REPLACE "[^/]+" ".." FX_PC_PREFIX "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
foreach(name fxsdk fxsdk-static)
    configure_file("${PROJECT_SOURCE_DIR}/cmake/${name}.pc.in" "${PROJECT_BINARY_DIR}/${name}.pc" @ONLY)
endforeach()
install(FILES "${PROJECT_BINARY_DIR}/fxsdk.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT dev)
if(TARGET fxsdk_static)
    install(FILES "${PROJECT_BINARY_DIR}/fxsdk-static.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT dev)
endif()

if(TARGET fx_editor)
    set(FX_EDITOR_DIR "${FX_DATA_DIR}/editor")
    install(FILES "$<TARGET_FILE:fx_editor>" DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT editor OPTIONAL)
    foreach(folder panels embed)
        install(DIRECTORY "${PROJECT_SOURCE_DIR}/fxsdk/editor/${folder}" DESTINATION "${FX_EDITOR_DIR}/fxsdk/editor" COMPONENT editor
            FILES_MATCHING PATTERN "*.cpp")
    endforeach()
    foreach(folder foundation fxsdk rendering simulation)
        install(DIRECTORY "${PROJECT_SOURCE_DIR}/${folder}" DESTINATION "${FX_EDITOR_DIR}" COMPONENT editor
            FILES_MATCHING PATTERN "*.h" PATTERN "*.inl" PATTERN "fxsdk/include" EXCLUDE PATTERN "fxsdk/livelink/include" EXCLUDE
            PATTERN "fxsdk/editor/program" EXCLUDE PATTERN "fxsdk/python" EXCLUDE)
    endforeach()
endif()

foreach(page README.md CHANGELOG.md docs examples)
    if(IS_DIRECTORY "${PROJECT_SOURCE_DIR}/${page}")
        install(DIRECTORY "${PROJECT_SOURCE_DIR}/${page}" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT doc)
    else()
        install(FILES "${PROJECT_SOURCE_DIR}/${page}" DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT doc)
    endif()
endforeach()
install(DIRECTORY "${PROJECT_SOURCE_DIR}/fxsdk/presets/library/" "${PROJECT_BINARY_DIR}/fxsdk/presets/library/"
    DESTINATION "${FX_DATA_DIR}/presets" COMPONENT tools
    FILES_MATCHING PATTERN "*.fx.json" PATTERN "*.fxvolume" PATTERN "*.obj" PATTERN "*.mtl" PATTERN "*.png")
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
    file(RELATIVE_PATH to_libraries "/${CMAKE_INSTALL_BINDIR}" "/${CMAKE_INSTALL_LIBDIR}")
    set_target_properties(fx PROPERTIES INSTALL_RPATH "$ORIGIN/${to_libraries}")
    # An old DT_RPATH is that of the libraries of libraries as well.
    target_link_options(fx PRIVATE -Wl,--disable-new-dtags)
    install(TARGETS fx RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT tools OPTIONAL)
    install(FILES ${schemas} DESTINATION "${FX_DATA_DIR}/schema" COMPONENT tools OPTIONAL)
endif()
