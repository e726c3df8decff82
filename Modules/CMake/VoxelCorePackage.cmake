# What `cmake --install` puts where, and the files by which other projects find it. Every path is relative to the
# prefix,
# so the installed tree may be moved.
include(CMakePackageConfigHelpers)
set(VOXELCORE_CONFIG_DIR "${CMAKE_INSTALL_LIBDIR}/cmake/VoxelCore")

# A component of find_package(VoxelCore COMPONENTS ...) is a set of libraries and the components it builds on; what is
# not built is left out.
set(VOXELCORE_COMPONENTS Core Imaging Models Display Jobs ITK VTK)
set(component_Core ${VOXELCORE_CORE_ROOMS} Core)
set(component_Imaging Formats ItkReader Imaging)
foreach(component Display ITK VTK)
  set(component_${component} ${component})
endforeach()
set(component_Models Models VesselsTables)
set(component_Jobs Report Jobs Options)
foreach(street ${VOXELCORE_ROOMS_Uses})
  list(APPEND component_Jobs ${street}Job)
endforeach()

set(VOXELCORE_BUILT_COMPONENTS "")
foreach(component ${VOXELCORE_COMPONENTS})
  set(targets "")
  foreach(library ${component_${component}})
    if(TARGET VoxelCore${library})
      list(APPEND targets VoxelCore${library})
    endif()
  endforeach()
  if(targets)
    list(APPEND VOXELCORE_BUILT_COMPONENTS ${component})
    install(TARGETS ${targets} EXPORT VoxelCore-${component}
      ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development)
    install(EXPORT VoxelCore-${component} NAMESPACE VoxelCore:: DESTINATION "${VOXELCORE_CONFIG_DIR}"
      COMPONENT development)
  endif()
endforeach()

if(TARGET voxelcore_itk_reader)
  install(TARGETS voxelcore_itk_reader RUNTIME DESTINATION "${CMAKE_INSTALL_LIBEXECDIR}/voxelcore" COMPONENT program)
endif()

# Only public headers lie in an include folder. Those of ITK and VTK classes need these libraries.
foreach(module ${VOXELCORE_MODULES})
  if(EXISTS "${PROJECT_SOURCE_DIR}/Modules/${VOXELCORE_FOLDER_${module}}/include/voxelcore")
    install(DIRECTORY "${PROJECT_SOURCE_DIR}/Modules/${VOXELCORE_FOLDER_${module}}/include/voxelcore"
      DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT development FILES_MATCHING PATTERN "*.h")
  endif()
  foreach(library ITK VTK)
    if(TARGET VoxelCore${library})
      string(TOLOWER ${library} prefix)
      file(GLOB headers CONFIGURE_DEPENDS
          "${PROJECT_SOURCE_DIR}/Modules/${VOXELCORE_FOLDER_${module}}/include/${prefix}*.h"
        "${PROJECT_SOURCE_DIR}/Modules/${VOXELCORE_FOLDER_${module}}/include/${prefix}*.hxx")
      install(FILES ${headers} DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT development)
    endif()
  endforeach()
endforeach()

string(REPLACE ";" " " VOXELCORE_DISPLAY_VTK_MODULES "${VOXELCORE_DISPLAY_VTK}")
set(VOXELCORE_NEEDS_BZIP2 OFF)
set(VOXELCORE_NEEDS_JPEG OFF)
if(TARGET VoxelCoreFormats)
  get_target_property(libraries VoxelCoreFormats LINK_LIBRARIES)
  if("BZip2::BZip2" IN_LIST libraries)
    set(VOXELCORE_NEEDS_BZIP2 ON)
  endif()
  if("JPEG::JPEG" IN_LIST libraries)
    set(VOXELCORE_NEEDS_JPEG ON)
  endif()
endif()
configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/VoxelCoreConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/VoxelCoreConfig.cmake" INSTALL_DESTINATION "${VOXELCORE_CONFIG_DIR}"
  NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/VoxelCoreConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/VoxelCoreConfig.cmake" "${PROJECT_BINARY_DIR}/VoxelCoreConfigVersion.cmake"
  "${CMAKE_CURRENT_LIST_DIR}/FindTetGen.cmake" "${CMAKE_CURRENT_LIST_DIR}/FindBlosc.cmake"
  "${CMAKE_CURRENT_LIST_DIR}/FindZstd.cmake" DESTINATION "${VOXELCORE_CONFIG_DIR}" COMPONENT development)
