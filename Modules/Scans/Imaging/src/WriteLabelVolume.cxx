#include "OpenScan.h"
#include "voxelcore/Base/OutputFile.h"
#include "voxelcore/Base/TemporaryNames.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Formats/FormatOpeners.h"
#include "voxelcore/Formats/VolumeWriters.h"
#include "voxelcore/Imaging/GreyVolume.h"
#include "voxelcore/Imaging/LabelVolume.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace voxelcore
{
namespace
{

enum class Kind
{
  Nrrd,
  Nifti,
  Meta,
  Tiff,
  Zarr
};

Kind
KindOf(const std::filesystem::path & path)
{
  const std::string name = LowerCase(path.filename().string());
  const auto        ends = [&name](std::string_view extension) {
    return name.size() > extension.size() && name.ends_with(extension);
  };
  if (ends(".nrrd"))
  {
    return Kind::Nrrd;
  }
  if (ends(".nii") || ends(".nii.gz"))
  {
    return Kind::Nifti;
  }
  if (ends(".mha") || ends(".mhd"))
  {
    return Kind::Meta;
  }
  if (ends(".tif") || ends(".tiff"))
  {
    return Kind::Tiff;
  }
  if (ends(".zarr"))
  {
    return Kind::Zarr;
  }
  throw UsageError(
    Text(Printable(path.string(), 4096), ": unknown extension; give .nrrd .nii .nii.gz .mha .mhd .tif or .ome.zarr"));
}

PixelType
SmallestType(const std::vector<LabelShape> & labels, const std::filesystem::path & path)
{
  std::int64_t largest = 0;
  for (const LabelShape & label : labels)
  {
    if (label.value < 1)
    {
      throw UsageError(Text(path.string(), ": label ", label.value, " cannot be written; give values from 1 on"));
    }
    largest = std::max(largest, label.value);
  }
  if (largest <= UINT8_MAX)
  {
    return PixelType::UInt8;
  }
  if (largest <= UINT16_MAX)
  {
    return PixelType::UInt16;
  }
  return largest <= UINT32_MAX ? PixelType::UInt32 : PixelType::UInt64;
}

void
RequireWithin(const std::filesystem::path & path, const std::array<std::int64_t, 3> & size, const LabelShape & label)
{
  const VoxelBox & box = label.shape.Box();
  for (std::size_t a = 0; a < 3; ++a)
  {
    if (box.size[a] > 0 && (box.lower[a] < 0 || std::int64_t{ box.lower[a] } + box.size[a] > size[a]))
    {
      throw UsageError(Text(path.string(),
                            ": label ",
                            label.value,
                            " reaches beyond the volume it is written into; give a larger one"));
    }
  }
}

/** The voxels of slice k, i fastest. \throws UsageError where labels overlap */
template <typename T>
void
FillSlice(const std::filesystem::path &       path,
          const std::array<std::int64_t, 3> & size,
          const std::vector<LabelShape> &     labels,
          std::int64_t                        k,
          std::vector<std::byte> &            bytes)
{
  std::fill(bytes.begin(), bytes.end(), std::byte{ 0 });
  auto * const voxels = reinterpret_cast<T *>(bytes.data());
  for (const LabelShape & label : labels)
  {
    const VoxelBox &   box = label.shape.Box();
    const std::int64_t z = k - box.lower[2];
    if (z < 0 || z >= box.size[2])
    {
      continue;
    }
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      const auto row = label.shape.Row(y, static_cast<std::int32_t>(z));
      T * const  to = voxels + (y + box.lower[1]) * size[0] + box.lower[0];
      for (std::size_t w = 0; w < row.size(); ++w)
      {
        for (std::uint64_t bits = row[w]; bits != 0; bits &= bits - 1)
        {
          T & voxel = to[w * 64 + static_cast<std::size_t>(std::countr_zero(bits))];
          if (voxel != 0)
          {
            throw UsageError(Text(path.string(),
                                  ": labels ",
                                  +voxel,
                                  " and ",
                                  label.value,
                                  " overlap; one volume holds one label a voxel: write them apart"));
          }
          voxel = static_cast<T>(label.value);
        }
      }
    }
  }
}

/** Slices as they are asked for, one at a time. */
SliceSource
SlicesOf(const std::filesystem::path &       path,
         const std::array<std::int64_t, 3> & size,
         const std::vector<LabelShape> &     labels,
         PixelType                           type,
         std::vector<std::byte> &            bytes)
{
  bytes.resize(static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]) * PixelBytes(type));
  return [&, type](std::int64_t k) -> std::span<const std::byte> {
    switch (type)
    {
      case PixelType::UInt8:
        FillSlice<std::uint8_t>(path, size, labels, k, bytes);
        break;
      case PixelType::UInt16:
        FillSlice<std::uint16_t>(path, size, labels, k, bytes);
        break;
      case PixelType::UInt32:
        FillSlice<std::uint32_t>(path, size, labels, k, bytes);
        break;
      default:
        FillSlice<std::uint64_t>(path, size, labels, k, bytes);
        break;
    }
    return bytes;
  };
}

/** Reads the file back: writers that meet a full disk, or a number their format cannot hold, do not always say so. */
void
CheckWritten(const std::filesystem::path & path,
             Kind                          kind,
             const ImageGeometry &         geometry,
             PixelType                     type,
             const SliceSource &           slice)
{
  ReadOptions    options;
  const ScanFile scan = OpenScan(path, options);
  bool           same = scan.geometry.size == geometry.size && scan.type == type && !scan.IsScaled();
  same = same && scan.geometry.unit == geometry.unit;
  // NIfTI and TIFF keep single precision, TIFF of the spacing alone; OME-Zarr has words for directions.
  const bool   isExact = kind == Kind::Nrrd || kind == Kind::Meta;
  const double tolerance = isExact ? 1e-9 : 1e-5;
  for (std::size_t a = 0; a < 3; ++a)
  {
    same = same && std::abs(scan.geometry.spacing[a] - geometry.spacing[a]) <= tolerance * geometry.spacing[a];
  }
  for (std::size_t a = 0; a < 3 && kind != Kind::Tiff; ++a)
  {
    same =
      same && std::abs(scan.geometry.origin[a] - geometry.origin[a]) <= tolerance * (1 + std::abs(geometry.origin[a]));
    for (std::size_t c = 0; c < 3; ++c)
    {
      same = same && std::abs(scan.geometry.direction[3 * c + a] - geometry.direction[3 * c + a]) <= 10 * tolerance;
    }
  }
  std::vector<std::byte> part;
  for (std::int64_t k = 0; same && k < geometry.size[2] && !scan.swapBytes; ++k) // never swapped on files written here
  {
    const auto voxels = slice(k);
    part.resize(voxels.size());
    scan.voxels->Read(part.data(), part.size());
    same = std::memcmp(part.data(), voxels.data(), part.size()) == 0;
  }
  if (!same)
  {
    throw Error(
      Text("what was written reads back differently; choose another format (.nrrd holds everything) "
           "and check the disk"));
  }
}

/** A folder beside the result in which it comes to be: a killed run leaves no half file under the final name. */
class StagingFolder
{
public:
  explicit StagingFolder(const std::filesystem::path & result)
    : m_Result(result)
    , m_Folder(TemporaryName(result))
  {
    RemoveAbandoned(result.has_parent_path() ? result.parent_path() : std::filesystem::path("."));
    std::error_code error;
    if (!std::filesystem::create_directory(m_Folder, error))
    {
      FailOutput(result, error ? error.value() : EEXIST);
    }
  }
  StagingFolder(const StagingFolder &) = delete;
  StagingFolder &
  operator=(const StagingFolder &) = delete;
  ~StagingFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(m_Folder, ignored);
  }

  std::filesystem::path
  File() const
  {
    return m_Folder / m_Result.filename();
  }

  /** Moves what was made to its place, the named file last: a header never stands without its data. */
  void
  Publish() const
  {
    for (const auto & entry : std::filesystem::directory_iterator(m_Folder))
    {
      if (entry.path() != File())
      {
        std::filesystem::rename(entry.path(), m_Result.parent_path() / entry.path().filename());
      }
    }
    if (IsZarr(m_Result)) // no folder takes the name of one that holds something
    {
      std::filesystem::rename(m_Result, m_Folder / "former");
    }
    std::filesystem::rename(File(), m_Result);
  }

private:
  std::filesystem::path m_Result;
  std::filesystem::path m_Folder;
};

std::string
OneLine(std::string text)
{
  std::replace(text.begin(), text.end(), '\n', ' ');
  return Printable(Trim(text), 200);
}

/** \throws UsageError for a size the format cannot hold. */
void
RequireSize(const std::filesystem::path & staged, Kind kind, const std::array<std::int64_t, 3> & size)
{
  const std::filesystem::path path = FinalName(staged);
  const auto                  longest = std::max({ size[0], size[1], size[2] });
  if (std::min({ size[0], size[1], size[2] }) < 1 || longest > (std::int64_t{ 1 } << 30))
  {
    throw UsageError(Text(path.string(),
                          ": a volume of ",
                          size[0],
                          " x ",
                          size[1],
                          " x ",
                          size[2],
                          " voxels; give each side one or more"));
  }
  if (kind == Kind::Nifti && longest > INT16_MAX)
  {
    throw UsageError(Text(path.string(), ": NIfTI-1 holds sides up to 32767 voxels; write .nrrd"));
  }
  if (kind == Kind::Tiff && size[2] < 2)
  {
    throw UsageError(Text(path.string(), ": one page is a picture, not a volume; write .nrrd"));
  }
}

/** Writes, reads back, and only then gives the file its name. */
void
WriteVolume(const std::filesystem::path & path, Kind kind, const VolumeToWrite & volume)
{
  const StagingFolder staging(path);
  const auto          fail = [&path](const std::string & why) {
    throw OutputError(Text(Printable(FinalName(path).string(), 4096),
                           ": cannot be written (",
                           OneLine(why),
                           "); check permissions and disk"));
  };
  try
  {
    switch (kind)
    {
      case Kind::Nrrd:
        WriteNrrd(staging.File(), volume);
        break;
      case Kind::Nifti:
        WriteNifti(staging.File(), volume);
        break;
      case Kind::Meta:
        WriteMetaImage(staging.File(), volume);
        break;
      case Kind::Tiff:
        WriteTiff(staging.File(), volume);
        break;
      case Kind::Zarr:
        WriteOmeZarr(staging.File(), volume);
        break;
    }
    CheckWritten(staging.File(), kind, volume.geometry, volume.type, volume.slice);
    staging.Publish();
  }
  catch (const OutputError &)
  {
    throw;
  }
  catch (const UsageError & error)
  {
    throw UsageError(Text(Printable(FinalName(path).string(), 4096), ": ", error.what()));
  }
  catch (const std::filesystem::filesystem_error & error)
  {
    fail(error.code().message());
  }
  catch (const Error & error)
  {
    fail(error.what());
  }
}

} // namespace

void
WriteLabelVolume(const std::filesystem::path &   path,
                 const ImageGeometry &           geometry,
                 const std::vector<LabelShape> & labels,
                 bool                            compress)
{
  const Kind      kind = KindOf(path);
  const PixelType type = SmallestType(labels, path);
  const auto &    size = geometry.size;
  RequireSize(path, kind, size);
  std::vector<std::byte> bytes;
  const SliceSource      slice = SlicesOf(path, size, labels, type, bytes);
  for (const LabelShape & label : labels)
  {
    RequireWithin(path, size, label);
  }
  for (std::int64_t k = 0; k < size[2] && labels.size() > 1; ++k)
  {
    slice(k); // says where labels overlap before anything is written
  }
  VolumeToWrite                         volume{ geometry, type, slice, compress };
  std::map<std::int64_t, ListedLabel> & names = volume.labels.emplace();
  for (const LabelShape & label : labels)
  {
    names[label.value] = { label.name, label.color };
  }
  WriteVolume(path, kind, volume);
}

void
WriteGreyVolume(const std::filesystem::path &  path,
                const ImageGeometry &          geometry,
                std::span<const std::uint16_t> values,
                bool                           compress)
{
  const Kind kind = KindOf(path);
  RequireSize(path, kind, geometry.size);
  const auto plane = static_cast<std::size_t>(geometry.size[0]) * static_cast<std::size_t>(geometry.size[1]);
  if (values.size() != plane * static_cast<std::size_t>(geometry.size[2]))
  {
    throw UsageError(Text(path.string(), ": ", values.size(), " values do not fill the volume; give one a voxel"));
  }
  const SliceSource slice = [&](std::int64_t k) {
    return std::as_bytes(values.subspan(static_cast<std::size_t>(k) * plane, plane));
  };
  WriteVolume(path, kind, { geometry, PixelType::UInt16, slice, compress });
}

namespace
{

template <typename T>
void
WriteSlices(const std::filesystem::path &                           path,
            const ImageGeometry &                                   geometry,
            PixelType                                               type,
            const std::function<void(std::int64_t, std::span<T>)> & slice)
{
  const Kind kind = KindOf(path);
  RequireSize(path, kind, geometry.size);
  std::vector<T>    values(static_cast<std::size_t>(geometry.size[0]) * static_cast<std::size_t>(geometry.size[1]));
  const SliceSource bytes = [&](std::int64_t k) -> std::span<const std::byte> {
    std::fill(values.begin(), values.end(), T{ 0 });
    slice(k, values);
    return std::as_bytes(std::span<const T>(values));
  };
  VolumeToWrite volume{ geometry, type, bytes };
  if (type != PixelType::Float32)
  {
    volume.labels.emplace();
  }
  WriteVolume(path, kind, volume);
}

} // namespace

void
WriteFloatVolume(const std::filesystem::path & path, const ImageGeometry & geometry, const FloatSlice & slice)
{
  WriteSlices<float>(path, geometry, PixelType::Float32, slice);
}

void
WriteNumberVolume(const std::filesystem::path & path, const ImageGeometry & geometry, const NumberSlice & slice)
{
  WriteSlices<std::uint32_t>(path, geometry, PixelType::UInt32, slice);
}

void
RequireVolumePath(const std::filesystem::path & path)
{
  KindOf(path);
}

std::string
WhatIsLeftOut(const std::filesystem::path & path, const ImageGeometry & geometry)
{
  const ImageGeometry plain;
  if (KindOf(path) != Kind::Tiff || (geometry.origin == plain.origin && geometry.direction == plain.direction))
  {
    return {};
  }
  return path.string() + ": TIFF holds no origin and no directions of axes; .nrrd holds everything";
}

void
RequireVolumeFits(const std::filesystem::path & path, const std::array<std::int64_t, 3> & size)
{
  RequireSize(path, KindOf(path), size);
}

} // namespace voxelcore
