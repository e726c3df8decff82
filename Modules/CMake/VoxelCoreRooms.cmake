# The house: five groups, and in each its rooms, in the order in which they are built. What a room may use, README.md
# and Testing/layers.sh say. A new room is a folder Modules/<group>/<room> and its name here.
set(VOXELCORE_GROUPS Core Scans Models Program Uses)
set(VOXELCORE_ROOMS_Core
  Base Lattice Complex Shape Delaunay VoxelCore Refinement Skeleton Verification Certified)
set(VOXELCORE_ROOMS_Scans
  Labels Masks Formats ItkReader Imaging ITK)
set(VOXELCORE_ROOMS_Models
  Models VTK Display)
set(VOXELCORE_ROOMS_Program
  Report Jobs Options)
set(VOXELCORE_ROOMS_Uses
  Blocks Meshes Phantom Thickness Sheets Vessels Roots Compare Corrections Follow Cohort)

set(VOXELCORE_ROOMS "")
foreach(group ${VOXELCORE_GROUPS})
  list(APPEND VOXELCORE_ROOMS ${VOXELCORE_ROOMS_${group}})
  foreach(room ${VOXELCORE_ROOMS_${group}})
    set(VOXELCORE_FOLDER_${room} ${group}/${room}) # in Modules, and in Testing
  endforeach()
endforeach()
