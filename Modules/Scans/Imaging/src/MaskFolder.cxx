#include "MaskFolder.h"

#include "OpenScan.h"
#include "SlabReader.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Formats/FormatOpeners.h"
#include "voxelcore/Labels/ScaledValue.h"
#include "voxelcore/Lattice/GridOffset.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace voxelcore
{
namespace
{

namespace fs = std::filesystem;

constexpr const char * kCohort = "keep masks of one scan in a folder; for many scans use 'voxelcore batch'";

/** The name of a structure: that of the file without its extensions. */
std::string
StructureName(const fs::path & file)
{
  const std::string name = file.filename().string();
  const std::string lower = LowerCase(name);
  for (const std::string_view extension : { ".nii.gz", ".mgh.gz" })
  {
    if (lower.ends_with(extension) && lower.size() > extension.size())
    {
      return name.substr(0, name.size() - extension.size());
    }
  }
  return file.stem().string();
}

/** The masks side by side: of each voxel a value from each, its number where it is in and 0 where not. */
class InterleavedMasks : public ByteStream
{
public:
  InterleavedMasks(fs::path folder, std::vector<ScanFile> masks)
    : ByteStream(std::move(folder))
    , m_Values(masks.size(), 0)
    , m_Masks(std::move(masks))
  {
    m_Left = 1;
    for (const std::int64_t side : m_Masks.front().geometry.size)
    {
      m_Left *= static_cast<std::uint64_t>(side);
    }
  }

  std::size_t
  ReadSome(std::byte * to, std::size_t count) override
  {
    std::size_t given = 0;
    while (given < count && (m_At < m_Buffer.size() || Fill()))
    {
      const std::size_t part = std::min(count - given, m_Buffer.size() - m_At);
      std::copy_n(m_Buffer.begin() + static_cast<std::ptrdiff_t>(m_At), part, to + given);
      m_At += part;
      given += part;
    }
    return given;
  }

  bool
  Finish() override
  {
    bool hasMore = false;
    for (ScanFile & mask : m_Masks)
    {
      hasMore = (!mask.moreVolumes && mask.voxels->Finish() && !mask.hasMore) || hasMore;
    }
    return hasMore;
  }

private:
  using Stored = std::uint16_t;

  bool
  Fill()
  {
    constexpr std::uint64_t kVoxels = 16384;
    const auto              voxels = static_cast<std::size_t>(std::min(kVoxels, m_Left));
    m_Left -= voxels;
    m_At = 0;
    m_Buffer.assign(voxels * m_Masks.size() * sizeof(Stored), std::byte{ 0 });
    for (std::size_t n = 0; n < m_Masks.size(); ++n)
    {
      const ScanFile &  mask = m_Masks[n];
      const std::size_t each = PixelBytes(mask.type);
      m_Stored.resize(voxels * each);
      mask.voxels->Read(m_Stored.data(), m_Stored.size());
      if (mask.swapBytes)
      {
        SwapValues(m_Stored.data(), m_Stored.size(), mask.type);
      }
      const auto number = static_cast<Stored>(n + 1);
      for (std::size_t v = 0; v < voxels; ++v)
      {
        if (IsIn(n, ScaledValue(mask, StoredValue(m_Stored.data() + v * each, mask.type))))
        {
          std::memcpy(m_Buffer.data() + (v * m_Masks.size() + n) * sizeof(Stored), &number, sizeof(Stored));
        }
      }
    }
    return voxels > 0;
  }

  bool
  IsIn(std::size_t n, double value)
  {
    if (value == 0)
    {
      return false;
    }
    if (m_Values[n] == 0 && std::isfinite(value))
    {
      m_Values[n] = value;
    }
    if (value != m_Values[n])
    {
      RefuseInput(m_Masks[n].path,
                  Text("the values ", Number(m_Values[n]), " and ", Number(value), " in a folder of masks"),
                  "name this file by itself if it holds labels");
    }
    return true;
  }
  std::vector<double>    m_Values; ///< of each mask the one besides 0
  std::vector<ScanFile>  m_Masks;
  std::vector<std::byte> m_Stored;
  std::vector<std::byte> m_Buffer;
  std::size_t            m_At = 0;
  std::uint64_t          m_Left;
};

} // namespace

std::vector<fs::path>
MaskPaths(const fs::path & folder)
{
  std::vector<fs::path> files;
  std::error_code       ignored;
  if (!fs::is_directory(folder, ignored) || HasSlices(folder))
  {
    return files;
  }
  for (const auto & entry : fs::directory_iterator(folder, ignored))
  {
    const std::string name = LowerCase(entry.path().filename().string());
    const ScanKind    kind = ScanKindOf(entry.path());
    const bool        isVolume = kind == ScanKind::Nrrd || kind == ScanKind::Nifti || kind == ScanKind::MetaImage ||
                          kind == ScanKind::Mgh || kind == ScanKind::Numpy;
    // The voxels of a .hdr.
    const bool isPartner = name.ends_with(".img") || name.ends_with(".img.gz");
    if (isVolume && !isPartner && !name.starts_with('.') && entry.is_regular_file(ignored))
    {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

ScanFile
OpenMaskFolder(const fs::path & folder, const std::vector<fs::path> & paths, const ReadOptions & options)
{
  ScanFile              scan;
  std::vector<ScanFile> masks;
  for (const fs::path & file : paths)
  {
    masks.push_back(OpenScan(file, options));
    const ScanFile & mask = masks.back();
    if (mask.interleaved > 1)
    {
      RefuseInput(file, "several values a voxel in a folder of masks", "name this file by itself");
    }
    constexpr double close = 0.01; // voxels: NIfTI keeps places in single precision
    if (!HaveSameVoxels(masks.front().geometry, mask.geometry, close))
    {
      RefuseInput(folder,
                  Text("'",
                       Printable(file.filename().string()),
                       "' has another grid than '",
                       Printable(masks.front().path.filename().string()),
                       "'"),
                  kCohort);
    }
    if (masks.size() > std::numeric_limits<std::uint16_t>::max())
    {
      RefuseInput(folder, "more than 65535 masks", kCohort);
    }
    Segment segment;
    segment.name = StructureName(file);
    segment.layer = masks.size() - 1;
    segment.value = static_cast<std::int64_t>(masks.size());
    scan.segments.push_back(std::move(segment));
  }
  const ScanFile & first = masks.front();
  scan.path = folder;
  scan.format = Text("folder of masks (", first.format, ")");
  scan.type = PixelType::UInt16;
  scan.geometry = first.geometry;
  scan.interleaved = masks.size();
  scan.notes = first.notes;
  scan.warnings = first.warnings;
  scan.notes.push_back(Text(masks.size(), " masks, each a label called as its file"));
  scan.voxels = std::make_unique<InterleavedMasks>(folder, std::move(masks));
  return scan;
}

} // namespace voxelcore
