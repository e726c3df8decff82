// Arrays in HDF5 files that ITK did not write: of ilastik, h5py, Fiji, MATLAB 7.3 and others. The index that changes
// fastest is i.

#include "ScanSource.h"
#include "voxelcore/Base/TextFields.h"

#include <hdf5.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace voxelcore::itkreader
{
namespace
{

constexpr hsize_t     kSlabBytes = 8U << 20;
constexpr std::size_t kMostNamed = 8; ///< data sets that a refusal lists

/** A handle of the library, closed by the function that is meant for its kind. */
class Handle
{
public:
  Handle(hid_t id, herr_t (*close)(hid_t))
    : m_Id(id)
    , m_Close(close)
  {}
  Handle(const Handle &) = delete;
  Handle &
  operator=(const Handle &) = delete;
  ~Handle()
  {
    if (m_Id >= 0)
    {
      m_Close(m_Id);
    }
  }
  hid_t
  Id() const
  {
    return m_Id;
  }

private:
  hid_t m_Id;
  herr_t (*m_Close)(hid_t);
};

std::vector<hsize_t>
ShapeOf(hid_t dataset)
{
  const Handle space(H5Dget_space(dataset), H5Sclose);
  const int    rank = H5Sget_simple_extent_ndims(space.Id());
  if (rank <= 0 || rank > 32)
  {
    return {};
  }
  std::vector<hsize_t> shape(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space.Id(), shape.data(), nullptr);
  return shape;
}

std::string
ShapeText(const std::vector<hsize_t> & shape)
{
  std::string text;
  for (const hsize_t side : shape)
  {
    text += (text.empty() ? "" : " x ") + std::to_string(side);
  }
  return text;
}

bool
HoldsNumbers(hid_t dataset)
{
  const Handle      type(H5Dget_type(dataset), H5Tclose);
  const H5T_class_t kind = H5Tget_class(type.Id());
  return kind == H5T_INTEGER || kind == H5T_FLOAT || kind == H5T_ENUM;
}

/** Paths of all data sets of numbers with two axes or more. Links to other files are not followed. */
std::vector<std::string>
ArraysIn(hid_t file)
{
  std::vector<std::string> names;
  const auto               visit = [](hid_t object, const char * name, const H5O_info_t * info, void * to) -> herr_t {
    if (info->type == H5O_TYPE_DATASET)
    {
      const Handle dataset(H5Dopen2(object, name, H5P_DEFAULT), H5Dclose);
      if (dataset.Id() >= 0 && HoldsNumbers(dataset.Id()) && ShapeOf(dataset.Id()).size() >= 2)
      {
        static_cast<std::vector<std::string> *>(to)->emplace_back(name);
      }
    }
    return 0;
  };
  H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, visit, &names, H5O_INFO_BASIC);
  return names;
}

class Hdf5Source : public ScanSource
{
public:
  Hdf5Source(const std::filesystem::path & path, const std::string & wanted)
    : m_Path(path)
    , m_File(OpenFile(path), H5Fclose)
    , m_Name(Choose(wanted))
    , m_Dataset(H5Dopen2(m_File.Id(), m_Name.c_str(), H5P_DEFAULT), H5Dclose)
    , m_Shape(ShapeOf(m_Dataset.Id()))
  {
    CheckStorage();
    scan.format = "HDF5";
    scan.files = { path };
    ReadType();
    std::vector<std::size_t> axes; // the fastest first
    for (std::size_t axis = m_Shape.size(); axis-- > 0;)
    {
      if (m_Shape[axis] != 1)
      {
        axes.push_back(axis);
      }
    }
    if (axes.size() > 3 || axes.size() < 2)
    {
      RefuseInput(path,
                  Text("its array '", Printable(m_Name), "' has ", ShapeText(m_Shape), " values, which is no volume"),
                  "save one volume of it with h5py, or choose another array with --dataset NAME");
    }
    for (std::size_t i = 0; i < 3; ++i)
    {
      scan.size[i] = i < axes.size() ? static_cast<std::int64_t>(m_Shape[axes[i]]) : 1;
    }
    m_Slowest = axes.size() == 3 ? axes[2] : m_Shape.size();
    ReadSpacing(axes);
    scan.notes.push_back(
      Text("the array '", Printable(m_Name), "' of ", ShapeText(m_Shape), " values; its last index is i"));
    scan.storedType = PixelName(scan.type);
  }

  void
  Send(std::uint64_t, std::uint64_t, const Sink & sink) override
  {
    const Handle  space(H5Dget_space(m_Dataset.Id()), H5Sclose);
    const auto    slices = static_cast<hsize_t>(scan.size[2]);
    const hsize_t sliceBytes =
      static_cast<hsize_t>(scan.size[0]) * static_cast<hsize_t>(scan.size[1]) * PixelBytes(scan.type);
    const hsize_t        step = SlicesAtATime(sliceBytes);
    std::vector<hsize_t> first(m_Shape.size(), 0);
    std::vector<hsize_t> count = m_Shape;
    std::vector<char>    slab;
    for (hsize_t k = 0; k < slices; k += step)
    {
      const hsize_t now = std::min(step, slices - k);
      if (m_Slowest < m_Shape.size())
      {
        first[m_Slowest] = k;
        count[m_Slowest] = now;
      }
      slab.resize(sliceBytes * now);
      const Handle memory(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose);
      if (H5Sselect_hyperslab(space.Id(), H5S_SELECT_SET, first.data(), nullptr, count.data(), nullptr) < 0 ||
          H5Dread(m_Dataset.Id(), m_MemoryType, memory.Id(), space.Id(), H5P_DEFAULT, slab.data()) < 0)
      {
        RefuseInput(m_Path,
                    Text("the array '", Printable(m_Name), "' cannot be unpacked"),
                    "the file is damaged, or packed by a filter that is not there: save it again with gzip");
      }
      sink(slab.data(), slab.size());
    }
  }

private:
  static hid_t
  OpenFile(const std::filesystem::path & path)
  {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    H5PLset_loading_state(0); // no code that a file asks for
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0)
    {
      RefuseInput(path, "an HDF5 file that cannot be opened", "the file is damaged or still written to: fetch it anew");
    }
    return file;
  }

  std::string
  Choose(const std::string & wanted) const
  {
    const std::vector<std::string> names = ArraysIn(m_File.Id());
    if (names.empty())
    {
      RefuseInput(m_Path, "an HDF5 file without an array of numbers", "check what kind of file it is");
    }
    const std::string plain = wanted.substr(std::min(wanted.find_first_not_of('/'), wanted.size()));
    if (std::find(names.begin(), names.end(), plain) != names.end())
    {
      return plain;
    }
    if (wanted.empty() && names.size() == 1)
    {
      return names.front();
    }
    std::string list;
    for (std::size_t i = 0; i < std::min(names.size(), kMostNamed); ++i)
    {
      list += (i == 0 ? "'" : ", '") + Printable(names[i]) + "'";
    }
    list += names.size() > kMostNamed ? ", ..." : "";
    RefuseInput(m_Path,
                wanted.empty() ? Text("several arrays: ", list)
                               : Text("no array '", Printable(wanted), "'; there are ", list),
                "choose one with --dataset NAME");
  }

  /** Only what lies in this file. */
  void
  CheckStorage() const
  {
    const Handle how(H5Dget_create_plist(m_Dataset.Id()), H5Pclose);
    if (H5Pget_external_count(how.Id()) != 0 || H5Pget_layout(how.Id()) == H5D_VIRTUAL)
    {
      RefuseInput(m_Path,
                  Text("the array '", Printable(m_Name), "' lies in other files"),
                  "save it into one file with h5py");
    }
  }

  void
  ReadType()
  {
    const Handle      type(H5Dget_type(m_Dataset.Id()), H5Tclose);
    const std::size_t bytes = H5Tget_size(type.Id());
    const H5T_class_t kind = H5Tget_class(type.Id());
    if (kind == H5T_ENUM && bytes == 1) // truth values of h5py
    {
      m_MemoryType = H5Tget_native_type(type.Id(), H5T_DIR_ASCEND); // kept until the process ends
      scan.type = PixelType::UInt8;
      return;
    }
    const bool isSigned = H5Tget_sign(type.Id()) != H5T_SGN_NONE;
    const struct
    {
      H5T_class_t kind;
      std::size_t bytes;
      bool        isSigned;
      hid_t       memory;
      PixelType   type;
    } known[] = { { H5T_INTEGER, 1, false, H5T_NATIVE_UINT8, PixelType::UInt8 },
                  { H5T_INTEGER, 1, true, H5T_NATIVE_INT8, PixelType::Int8 },
                  { H5T_INTEGER, 2, false, H5T_NATIVE_UINT16, PixelType::UInt16 },
                  { H5T_INTEGER, 2, true, H5T_NATIVE_INT16, PixelType::Int16 },
                  { H5T_INTEGER, 4, false, H5T_NATIVE_UINT32, PixelType::UInt32 },
                  { H5T_INTEGER, 4, true, H5T_NATIVE_INT32, PixelType::Int32 },
                  { H5T_INTEGER, 8, false, H5T_NATIVE_UINT64, PixelType::UInt64 },
                  { H5T_INTEGER, 8, true, H5T_NATIVE_INT64, PixelType::Int64 },
                  { H5T_FLOAT, 2, true, H5T_NATIVE_FLOAT, PixelType::Float32 },
                  { H5T_FLOAT, 4, true, H5T_NATIVE_FLOAT, PixelType::Float32 },
                  { H5T_FLOAT, 8, true, H5T_NATIVE_DOUBLE, PixelType::Float64 } };
    for (const auto & one : known)
    {
      if (one.kind == kind && one.bytes == bytes && (kind == H5T_FLOAT || one.isSigned == isSigned))
      {
        m_MemoryType = one.memory;
        scan.type = one.type;
        return;
      }
    }
    RefuseInput(m_Path, Text("the array '", Printable(m_Name), "' has an unusual type"), "save it as uint16 with h5py");
  }

  /** `element_size_um` of Fiji's plugin and ilastik: along the array's axes, in micrometres. */
  void
  ReadSpacing(const std::vector<std::size_t> & axes)
  {
    if (axes.size() != 3 || H5Aexists(m_Dataset.Id(), "element_size_um") <= 0)
    {
      return;
    }
    const Handle attribute(H5Aopen(m_Dataset.Id(), "element_size_um", H5P_DEFAULT), H5Aclose);
    const Handle space(H5Aget_space(attribute.Id()), H5Sclose);
    double       um[3] = { 0, 0, 0 };
    if (H5Sget_simple_extent_npoints(space.Id()) != 3 || H5Aread(attribute.Id(), H5T_NATIVE_DOUBLE, um) < 0)
    {
      return;
    }
    for (std::size_t i = 0; i < 3; ++i)
    {
      scan.spacing[i] = um[2 - i] / 1000;
    }
  }

  /** As many slices as chunks are deep, so that each is unpacked once. */
  hsize_t
  SlicesAtATime(hsize_t sliceBytes) const
  {
    const hsize_t wanted = std::max<hsize_t>(1, kSlabBytes / std::max<hsize_t>(1, sliceBytes));
    const Handle  how(H5Dget_create_plist(m_Dataset.Id()), H5Pclose);
    if (m_Slowest == m_Shape.size() || H5Pget_layout(how.Id()) != H5D_CHUNKED)
    {
      return wanted;
    }
    std::vector<hsize_t> chunk(m_Shape.size(), 1);
    H5Pget_chunk(how.Id(), static_cast<int>(chunk.size()), chunk.data());
    const hsize_t deep = std::clamp<hsize_t>(chunk[m_Slowest], 1, static_cast<hsize_t>(scan.size[2]));
    return (wanted + deep - 1) / deep * deep;
  }

  std::filesystem::path m_Path;
  Handle                m_File;
  std::string           m_Name;
  Handle                m_Dataset;
  std::vector<hsize_t>  m_Shape;
  std::size_t           m_Slowest = 0; ///< the axis that is k; the number of axes where there is one slice
  hid_t                 m_MemoryType = -1;
};

} // namespace

std::unique_ptr<ScanSource>
OpenHdf5(const std::filesystem::path & path, const std::string & dataset)
{
  return std::make_unique<Hdf5Source>(path, dataset);
}

} // namespace voxelcore::itkreader
