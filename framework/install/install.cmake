# SPDX-License-Identifier: MIT
# What `cmake --install` copies: programs to bin, what they read to share/kaustik, what they start
# and load to lib/kaustik, and for programs of others the headers, the libraries and
# kaustikConfig.cmake. framework/core/files.cpp finds all of it by where the program is.
include(CMakePackageConfigHelpers)

# Builds all of it, without tests.
add_custom_target(installable DEPENDS kaustik)
if(TARGET kaustik_python)
    add_dependencies(installable kaustik_python)
endif()

install(TARGETS kaustik RUNTIME DESTINATION bin)
install(TARGETS kaustik_reader RUNTIME DESTINATION lib/kaustik)
if(TARGET kaustik_openimageio)
    install(TARGETS kaustik_openimageio LIBRARY DESTINATION lib/kaustik)
endif()
if(TARGET kaustik_exr_png)
    install(TARGETS kaustik_exr_png LIBRARY DESTINATION lib/kaustik)
endif()

# What editors are told about files.
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/schemas)
foreach(what scene experiment report)
    set(schema ${CMAKE_BINARY_DIR}/schemas/${what}.schema.json)
    add_custom_command(OUTPUT ${schema} COMMAND kaustik schema ${what} > ${schema} DEPENDS kaustik)
    list(APPEND kaustik_schemas ${schema})
endforeach()
add_custom_target(schemas ALL DEPENDS ${kaustik_schemas})
add_dependencies(installable schemas)
install(FILES ${kaustik_schemas} DESTINATION share/kaustik/schemas)

# Shaders include the headers that they share with C++.
install(DIRECTORY shaders DESTINATION share/kaustik)
install(DIRECTORY framework/transport DESTINATION share/kaustik/framework
        FILES_MATCHING PATTERN "*.h")
install(DIRECTORY techniques DESTINATION share/kaustik FILES_MATCHING PATTERN "*.h")
install(DIRECTORY experiments DESTINATION share/kaustik USE_SOURCE_PERMISSIONS
        PATTERN "__pycache__" EXCLUDE
        PATTERN "install_packages.sh" EXCLUDE
        PATTERN "quickstart.sh" EXCLUDE
        PATTERN "set_up.sh" EXCLUDE)
# Those that have been fetched; share/kaustik/experiments/fetch_meshes.sh fetches the others.
install(DIRECTORY meshes/ DESTINATION share/kaustik/meshes OPTIONAL)

install(DIRECTORY framework techniques DESTINATION include/kaustik FILES_MATCHING PATTERN "*.h")
set(kaustik_installed options core params graph reading scene image measure gl view render
    transport pipeline numerics report techniques technique_cases experiment exporters judge run app
    certify)
foreach(optional reference audit gui)
    if(TARGET kaustik_${optional})
        list(APPEND kaustik_installed ${optional})
    endif()
endforeach()
foreach(name IN LISTS kaustik_installed)
    set_target_properties(kaustik_${name} PROPERTIES EXPORT_NAME ${name})
    install(TARGETS kaustik_${name} EXPORT kaustik ARCHIVE DESTINATION lib)
endforeach()
install(EXPORT kaustik FILE kaustikTargets.cmake NAMESPACE kaustik:: DESTINATION lib/cmake/kaustik)

configure_package_config_file(framework/install/kaustikConfig.cmake.in kaustikConfig.cmake
    INSTALL_DESTINATION lib/cmake/kaustik NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(kaustikConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/kaustikConfig.cmake ${CMAKE_BINARY_DIR}/kaustikConfigVersion.cmake
        DESTINATION lib/cmake/kaustik)
