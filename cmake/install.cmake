# Installs the library with a CMake package, the program, its man page and its completion.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Octavo)
install(TARGETS octavo EXPORT OctavoTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
        FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT OctavoTargets NAMESPACE octavo:: DESTINATION ${package_dir})
configure_package_config_file(cmake/OctavoConfig.cmake.in ${CMAKE_CURRENT_BINARY_DIR}/OctavoConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/OctavoConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/OctavoConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/OctavoConfigVersion.cmake
        DESTINATION ${package_dir})

install(TARGETS octavo_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
# The program writes both itself, from the definitions that it parses with.
add_custom_command(OUTPUT octavo.1 octavo.bash octavo.zsh octavo.fish
                   COMMAND octavo_program man > octavo.1
                   COMMAND octavo_program completion bash > octavo.bash
                   COMMAND octavo_program completion zsh > octavo.zsh
                   COMMAND octavo_program completion fish > octavo.fish
                   DEPENDS octavo_program VERBATIM)
add_custom_target(octavo_manual ALL DEPENDS octavo.1 octavo.bash octavo.zsh octavo.fish)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/octavo.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/octavo.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        RENAME octavo)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/octavo.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions
        RENAME _octavo)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/octavo.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
