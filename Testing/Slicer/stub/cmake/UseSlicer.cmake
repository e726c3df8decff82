file(APPEND "${CMAKE_BINARY_DIR}/called.txt" "use ")

# Scripts and resources are copied below lib/qt-scripted-modules; one that is not there is an error.
macro(slicerMacroBuildScriptedModule)
  cmake_parse_arguments(MODULE "WITH_GENERIC_TESTS;WITH_SUBDIR" "NAME" "SCRIPTS;RESOURCES" ${ARGN})
  if(MODULE_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "slicerMacroBuildScriptedModule: unknown ${MODULE_UNPARSED_ARGUMENTS}")
  endif()
  foreach(file ${MODULE_SCRIPTS} ${MODULE_RESOURCES})
    configure_file("${CMAKE_CURRENT_SOURCE_DIR}/${file}"
      "${CMAKE_BINARY_DIR}/lib/qt-scripted-modules/${file}" COPYONLY)
  endforeach()
  file(APPEND "${CMAKE_BINARY_DIR}/called.txt" "module:${MODULE_NAME} ")
endmacro()

function(slicer_add_python_unittest)
  cmake_parse_arguments(TEST "" "SCRIPT" "SLICER_ARGS" ${ARGN})
  if(NOT EXISTS "${CMAKE_CURRENT_SOURCE_DIR}/${TEST_SCRIPT}")
    message(FATAL_ERROR "slicer_add_python_unittest: there is no ${TEST_SCRIPT}")
  endif()
  file(APPEND "${CMAKE_BINARY_DIR}/called.txt" "test:${TEST_SCRIPT} ")
endfunction()
