#pragma once

#include "voxelcore/Options/Command.h"
#include "voxelcore/Cohort/Manifest.h"
#include "voxelcore/Imaging/LabelVolume.h"
#include "voxelcore/Masks/VoxelChanges.h"
#include "voxelcore/Models/MedialModel.h"
#include "voxelcore/Models/PlainSurface.h"
#include "voxelcore/Models/ReadMesh.h"
#include "voxelcore/Models/SkeletonModel.h"

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <unistd.h>

namespace voxelcore::testing
{

/** A file that is made up again and again, in memory, in a folder of its own: what lies beside a scan may be read with
 *  it. Of a name with folders the first is copied. It is the scan that the file is part of, but for headers. */
class StagedFile
{
public:
  StagedFile(const std::filesystem::path & folder, const std::filesystem::path & name)
    : m_Folder("/dev/shm/voxelcore-staged-" + std::to_string(getpid()))
    , m_Scan(m_Folder / *name.begin())
    , m_File(m_Folder / name)
  {
    std::filesystem::create_directory(m_Folder);
    std::filesystem::copy(folder / *name.begin(), m_Scan, std::filesystem::copy_options::recursive);
  }

  StagedFile(const StagedFile &) = delete;
  StagedFile &
  operator=(const StagedFile &) = delete;

  ~StagedFile()
  {
    std::error_code ignored;
    std::filesystem::remove_all(m_Folder, ignored);
  }

  void
  Write(const char * bytes, std::size_t size) const
  {
    std::ofstream(m_File, std::ios::binary | std::ios::trunc).write(bytes, static_cast<std::streamsize>(size));
  }

  /** What is read: the file, or the folder it is part of. */
  const std::filesystem::path &
  Read() const
  {
    return m_File.extension() == ".nhdr" || m_File.extension() == ".mhd" ? m_File : m_Scan;
  }

private:
  std::filesystem::path m_Folder;
  std::filesystem::path m_Scan;
  std::filesystem::path m_File;
};

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
    ReadManifest(path, OptionsOfCases(Commands()));
  }
  else
  {
    ReadVoxelChanges(path);
  }
}

} // namespace voxelcore::testing
