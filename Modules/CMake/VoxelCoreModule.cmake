# The rules every module and every test program is built by.
add_library(VoxelCoreBuildRules INTERFACE)
target_compile_features(VoxelCoreBuildRules INTERFACE cxx_std_20)
# No contraction, no fast-math: the same bits on every machine.
target_compile_options(VoxelCoreBuildRules INTERFACE
  $<$<COMPILE_LANGUAGE:CXX>:-Wall;-Wextra;-Wshadow;-Wconversion;-Wno-sign-conversion;-ffp-contract=off>
  # Of 32-bit addresses: what is counted in 64 bits is an index of an array.
  $<$<PLATFORM_ID:Emscripten>:-Wno-shorten-64-to-32>
  # Of types in unnamed namespaces GCC asks that they stand in the file it was called for; here that includes it.
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<BOOL:${VOXELCORE_UNITY}>>:-Wno-subobject-linkage>
  $<$<AND:$<COMPILE_LANGUAGE:CXX>,$<BOOL:${VOXELCORE_WERROR}>>:-Werror>
  $<$<BOOL:${VOXELCORE_LEAN}>:-ffunction-sections;-fdata-sections>)

# voxelcore_library(target SOURCES...): a static library by these rules, alias VoxelCore::<target without VoxelCore>.
# A program or plugin linked with it exports nothing of it, nor of what it uses: all is hidden, and what Boost, ITK and
# VTK
# mark for export against that (type information, inline functions) is left out by the linker.
function(voxelcore_library target)
  add_library(${target} STATIC ${ARGN})
  string(SUBSTRING ${target} 9 -1 name)
  add_library(VoxelCore::${name} ALIAS ${target})
  target_include_directories(${target} PUBLIC "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>")
  foreach(folder include inner)
    if(IS_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}/${folder}")
      target_include_directories(${target} PUBLIC "$<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/${folder}>")
    endif()
  endforeach()
  target_compile_features(${target} PUBLIC cxx_std_20)
  set(movable ON)
  if(EMSCRIPTEN) # whose programs have one address
    set(movable OFF)
  endif()
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} CXX_EXTENSIONS ON POSITION_INDEPENDENT_CODE ${movable}
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:VoxelCoreBuildRules>)
  target_link_options(${target} INTERFACE
    $<$<PLATFORM_ID:Linux>:LINKER:--exclude-libs,$<TARGET_FILE_NAME:VoxelCore::${name}>>)
endfunction()

# voxelcore_module(Name SOURCES a.cxx ... PUBLIC targets... PRIVATE targets...)
# Builds the room at hand as the static library VoxelCore<Name>, alias VoxelCore::<Name>; of a street `job`, which is
# more than mathematics, as VoxelCore<Name>Job.
function(voxelcore_module name)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  voxelcore_library(VoxelCore${name} ${arg_SOURCES})
  target_link_libraries(VoxelCore${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
endfunction()

# voxelcore_command(Street Name): command/<Name>Command.cxx of the street has the command k<Name>Command.
# voxelcore_extension(Street Name): the same of k<Name>Extension, more options of another street's command.
# voxelcore_commands() makes Commands() of all, VoxelCore::Commands.
function(voxelcore_command street name)
  voxelcore_registered(Command ${street} ${name})
endfunction()
function(voxelcore_extension street name)
  voxelcore_registered(Extension ${street} ${name})
endfunction()
function(voxelcore_registered kind street name)
  voxelcore_library(VoxelCore${name}${kind} command/${name}${kind}.cxx)
  set(job VoxelCore::${street}Job)
  if(NOT TARGET ${job})
    set(job VoxelCore::${street})
  endif()
  target_link_libraries(VoxelCore${name}${kind} PUBLIC VoxelCore::Options ${job})
  # GCC 12 sees overlapping copies in `"text" + std::string(...)` that are not there (its bug 105651).
  target_compile_options(VoxelCore${name}${kind} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
  set_property(GLOBAL APPEND PROPERTY VOXELCORE_${kind}s ${name})
endfunction()

function(voxelcore_commands)
  set(declared "")
  set(libraries "")
  foreach(kind Command Extension)
    get_property(names GLOBAL PROPERTY VOXELCORE_${kind}s)
    foreach(name ${names})
      string(APPEND declared "extern const ${kind} k${name}${kind};\n")
      if(TARGET VoxelCore::${name}${kind})
        list(APPEND libraries VoxelCore::${name}${kind})
      endif()
    endforeach()
    list(TRANSFORM names REPLACE "(.+)" "&k\\1${kind}")
    list(JOIN names ", " all${kind}s)
  endforeach()
  file(CONFIGURE OUTPUT Commands.cxx CONTENT [=[
// All commands that streets have registered.

#include "voxelcore/Options/AssembleCommands.h"

#include <array>

namespace voxelcore
{

@declared@
std::span<const Command>
Commands()
{
  static constexpr auto commands = std::to_array<const Command *>({ @allCommands@ });
  static constexpr auto extensions = std::to_array<const Extension *>({ @allExtensions@ });
  static const auto     all = AssembleCommands(commands, extensions);
  return all;
}

} // namespace voxelcore
]=] @ONLY)
  voxelcore_library(VoxelCoreCommands "${CMAKE_CURRENT_BINARY_DIR}/Commands.cxx")
  target_link_libraries(VoxelCoreCommands PUBLIC VoxelCore::Options ${libraries})
endfunction()

# voxelcore_tests(Name [LABEL Room] SOURCES aGTest.cxx ... LIBRARIES targets... [ENVIRONMENT A=b ...])
# One test program a library; its tests carry the room's name as CTest label.
# Tests of a suite whose name starts with Heavy (with parameters: Prefix/Heavy) carry the label heavy instead.
function(voxelcore_tests name)
  cmake_parse_arguments(arg "" "LABEL" "SOURCES;LIBRARIES;ENVIRONMENT" ${ARGN})
  if(NOT arg_LABEL)
    set(arg_LABEL ${name})
  endif()
  set(target VoxelCore${name}Tests)
  add_executable(${target} ${arg_SOURCES})
  target_include_directories(${target} PRIVATE "${PROJECT_SOURCE_DIR}/Testing")
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS ON)
  target_link_libraries(${target} PRIVATE VoxelCoreBuildRules ${arg_LIBRARIES} GTest::gtest_main)
  # What is tested is optimized in full. Of the tests themselves, macros for the most part, -O3 makes half the build's
  # time.
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  gtest_discover_tests(${target} TEST_FILTER "-Heavy*:*/Heavy*" DISCOVERY_TIMEOUT 60
    PROPERTIES LABELS ${arg_LABEL} TIMEOUT 600 ENVIRONMENT "${arg_ENVIRONMENT}")
  gtest_discover_tests(${target} TEST_FILTER "Heavy*:*/Heavy*" DISCOVERY_TIMEOUT 60 TEST_LIST ${target}_heavy
    PROPERTIES LABELS heavy TIMEOUT 3600 ENVIRONMENT "${arg_ENVIRONMENT}")
endfunction()
