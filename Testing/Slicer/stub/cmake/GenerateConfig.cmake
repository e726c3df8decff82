# Slicer wants these of every extension.
foreach(name HOMEPAGE CATEGORY CONTRIBUTORS DESCRIPTION ICONURL SCREENSHOTURLS DEPENDS)
  if(NOT EXTENSION_${name})
    message(FATAL_ERROR "EXTENSION_${name} is not set")
  endif()
endforeach()
if(NOT PROJECT_NAME STREQUAL "VoxelCore")
  message(FATAL_ERROR "the extension's name is that of the project, and of its catalog entry")
endif()
file(APPEND "${CMAKE_BINARY_DIR}/called.txt" "config ")
file(WRITE "${CMAKE_BINARY_DIR}/addresses.txt"
  "${EXTENSION_HOMEPAGE}\n${EXTENSION_ICONURL}\n${EXTENSION_SCREENSHOTURLS}\n")
