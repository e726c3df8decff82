#pragma once

#include "voxelcore/LabelVolume.h"
#include "voxelcore/Manifest.h"
#include "voxelcore/MedialModel.h"
#include "voxelcore/PlainSurface.h"
#include "voxelcore/ReadMesh.h"
#include "voxelcore/SkeletonModel.h"
#include "voxelcore/VoxelChanges.h"

#include <filesystem>
#include <string>

namespace voxelcore::testing
{

/** Reads a file as a user's command would: kind is scan, mesh, model, skeleton, manifest or changes. Throws InputError
 *  for a file that is not as it should be. */
inline void
ReadByKind(const std::string & kind, const std::filesystem::path & path)
{
  if (kind == "scan")
  {
    ReadLabelVolume(path);
  }
  else if (kind == "mesh")
  {
    ReadMesh(path);
  }
  else if (kind == "model")
  {
    ReadPlainSurface(path);
    ReadModel(path, Precision::AsSaved);
  }
  else if (kind == "skeleton")
  {
    ReadSkeletonVtp(path);
  }
  else if (kind == "manifest")
  {
    ReadManifest(path);
  }
  else
  {
    ReadVoxelChanges(path);
  }
}

} // namespace voxelcore::testing
