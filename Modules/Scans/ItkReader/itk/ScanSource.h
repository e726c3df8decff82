#pragma once
// A scan that the helper program has opened: what it is, and how its voxels are sent.

#include "ItkScan.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace voxelcore::itkreader
{

/** Takes voxels as they come: i fastest, then j, then k, in this machine's byte order. */
using Sink = std::function<void(const char * bytes, std::size_t count)>;

class ScanSource
{
public:
  virtual ~ScanSource() = default;
  ScanSource() = default;
  ScanSource(const ScanSource &) = delete;
  ScanSource &
  operator=(const ScanSource &) = delete;

  ItkScan scan;

  /** All voxels of one volume; of scans whose components are sent one at a time, those of `component`.
   *  \throws InputError */
  virtual void
  Send(std::uint64_t volume, std::uint64_t component, const Sink & sink) = 0;
};

/** A DICOM file, or a folder with one series. \throws InputError */
std::unique_ptr<ScanSource>
OpenDicom(const std::filesystem::path & path);

/** A file that one of ITK's ImageIOs reads; of HDF5 also others' (OpenHdf5), which is meant where `dataset` is given.
 *  \throws InputError, itk::ExceptionObject */
std::unique_ptr<ScanSource>
OpenByImageIO(const std::filesystem::path & path, ItkFormat format, const std::string & dataset = {});

/** An array in an HDF5 file: `dataset` by its path, or the only one there is. \throws InputError */
std::unique_ptr<ScanSource>
OpenHdf5(const std::filesystem::path & path, const std::string & dataset);

} // namespace voxelcore::itkreader
