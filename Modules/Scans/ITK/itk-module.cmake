# What the module VoxelCore of ITK is and needs; README.md says how it is built.
itk_module(VoxelCore
  DEPENDS ITKCommon ITKIOImageBase ITKMesh ITKPath
  TEST_DEPENDS ITKTestKernel ITKIOMeta
  DESCRIPTION "Certified medial surfaces, curve skeletons and local thickness of labels"
  EXCLUDE_FROM_DEFAULT)
