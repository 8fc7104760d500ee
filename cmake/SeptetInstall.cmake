# What `cmake --install` copies, in two components: `programs` (with data and documents) and `development` (libraries, headers,
# samples). The target `installed` is all that has to be built for it,
# `programs` what its commands start: programs, and the modules that they load. Programs find data and module by their own place, so
# every prefix will do (program/resources.hpp).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(SEPTET_INSTALL_DATA ${CMAKE_INSTALL_DATADIR}/septet)
set(SEPTET_INSTALL_MODULES lib/septet/modules)
set(SEPTET_INSTALL_CONFIG ${CMAKE_INSTALL_LIBDIR}/cmake/septet)
add_custom_target(installed)
add_custom_target(programs)

# septet_install_programs(target…)
function(septet_install_programs)
  install(TARGETS ${ARGN} COMPONENT programs RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} LIBRARY DESTINATION ${SEPTET_INSTALL_MODULES})
  add_dependencies(installed ${ARGN})
  add_dependencies(programs ${ARGN})
endfunction()

# septet_install_libraries(name…): these of Septet's libraries and all of Septet's that they need, as septet::NAME.
function(septet_install_libraries)
  set(due ${ARGN})
  set(targets "")
  while(due)
    list(POP_FRONT due name)
    if(septet_${name} IN_LIST targets)
      continue()
    endif()
    list(APPEND targets septet_${name})
    set_target_properties(septet_${name} PROPERTIES EXPORT_NAME ${name})
    get_target_property(needed septet_${name} INTERFACE_LINK_LIBRARIES)
    list(FILTER needed INCLUDE REGEX "^septet_")
    list(TRANSFORM needed REPLACE "^septet_" "")
    list(APPEND due ${needed})
  endwhile()
  install(TARGETS ${targets} EXPORT septet COMPONENT development ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/septet
          FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/septet)
  add_dependencies(installed ${targets})
  install(EXPORT septet NAMESPACE septet:: FILE septetTargets.cmake DESTINATION ${SEPTET_INSTALL_CONFIG} COMPONENT development)
  configure_package_config_file(${CMAKE_SOURCE_DIR}/cmake/septetConfig.cmake.in ${CMAKE_BINARY_DIR}/septetConfig.cmake
                                INSTALL_DESTINATION ${SEPTET_INSTALL_CONFIG} PATH_VARS CMAKE_INSTALL_BINDIR SEPTET_INSTALL_DATA)
  write_basic_package_version_file(${CMAKE_BINARY_DIR}/septetConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${CMAKE_BINARY_DIR}/septetConfig.cmake ${CMAKE_BINARY_DIR}/septetConfigVersion.cmake ${CMAKE_SOURCE_DIR}/cmake/FindOsdCPU.cmake
          DESTINATION ${SEPTET_INSTALL_CONFIG} COMPONENT development)
endfunction()
