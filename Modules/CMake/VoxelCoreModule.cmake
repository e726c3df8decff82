# The rules every module and every test program is built by.
add_library(VoxelCoreBuildRules INTERFACE)
target_compile_features(VoxelCoreBuildRules INTERFACE cxx_std_20)
# No contraction, no fast-math: the same bits on every machine.
target_compile_options(VoxelCoreBuildRules INTERFACE
  $<$<COMPILE_LANGUAGE:CXX>:-Wall;-Wextra;-Wshadow;-Wconversion;-Wno-sign-conversion;-ffp-contract=off>
  $<$<AND:$<COMPILE_LANGUAGE:CXX>,$<BOOL:${VOXELCORE_WERROR}>>:-Werror>)

# voxelcore_module(Name SOURCES a.cxx ... PUBLIC targets... PRIVATE targets...)
# Builds Modules/<Name> as the static library VoxelCore<Name>, alias VoxelCore::<Name>.
function(voxelcore_module name)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target VoxelCore${name})
  add_library(${target} STATIC ${arg_SOURCES})
  add_library(VoxelCore::${name} ALIAS ${target})
  target_include_directories(${target} PUBLIC "${CMAKE_CURRENT_SOURCE_DIR}/include")
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS ON POSITION_INDEPENDENT_CODE ON)
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC} PRIVATE VoxelCoreBuildRules ${arg_PRIVATE})
endfunction()

# voxelcore_tests(Name SOURCES aGTest.cxx ... LIBRARIES targets... [ENVIRONMENT A=b ...])
# One test program per module; its tests carry the module's name as CTest label.
# Tests of a suite whose name starts with Heavy (with parameters: Prefix/Heavy) carry the label heavy instead.
function(voxelcore_tests name)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES;ENVIRONMENT" ${ARGN})
  set(target VoxelCore${name}Tests)
  add_executable(${target} ${arg_SOURCES})
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}/Testing")
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS ON)
  target_link_libraries(${target} PRIVATE VoxelCoreBuildRules ${arg_LIBRARIES} GTest::gtest_main)
  gtest_discover_tests(${target} TEST_FILTER "-Heavy*:*/Heavy*" DISCOVERY_TIMEOUT 60
    PROPERTIES LABELS ${name} TIMEOUT 600 ENVIRONMENT "${arg_ENVIRONMENT}")
  gtest_discover_tests(${target} TEST_FILTER "Heavy*:*/Heavy*" DISCOVERY_TIMEOUT 60 TEST_LIST ${target}_heavy
    PROPERTIES LABELS heavy TIMEOUT 3600 ENVIRONMENT "${arg_ENVIRONMENT}")
endfunction()
