#include "ImageIOHeaders.h"

#include "voxelcore/Base/TextFields.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <zlib.h>

namespace voxelcore::itkreader
{
namespace
{

constexpr double kMmInAngstrom = 1e-7;

std::string
FirstBytes(const std::filesystem::path & path, std::size_t count)
{
  std::string   bytes(count, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, file.gcount())));
  return bytes;
}

/** A value somewhere in a header. */
template <typename T>
T
At(const std::string & header, std::size_t offset, bool big)
{
  std::array<char, sizeof(T)> bytes;
  std::copy_n(header.begin() + static_cast<std::ptrdiff_t>(offset), sizeof(T), bytes.begin());
  if (big != (std::endian::native == std::endian::big))
  {
    std::reverse(bytes.begin(), bytes.end());
  }
  return std::bit_cast<T>(bytes);
}

std::uint64_t
VolumeBytes(const ItkScan & scan)
{
  std::uint64_t bytes = PixelBytes(scan.type) * scan.components * scan.volumes;
  for (const std::int64_t side : scan.size)
  {
    // The caller refuses sides that make no sense; here they must only not overflow.
    bytes = side > 0 && bytes < (std::uint64_t{ 1 } << 60) / static_cast<std::uint64_t>(side)
              ? bytes * static_cast<std::uint64_t>(side)
              : std::uint64_t{ 1 } << 60;
  }
  return bytes;
}

void
CheckLength(const std::filesystem::path & path, std::uint64_t length, std::uint64_t needed)
{
  if (length < needed)
  {
    RefuseInput(path, Text("it is truncated: ", length, " of ", needed, " bytes"), "fetch or write it anew");
  }
}

/** The 256 words of MRC2014, counted from 1. */
class MrcHeader
{
public:
  explicit MrcHeader(const std::filesystem::path & path)
    : m_Bytes(FirstBytes(path, 1024))
  {
    CheckLength(path, m_Bytes.size(), 1024);
  }

  template <typename T>
  T
  Word(std::size_t number) const
  {
    return At<T>(m_Bytes, 4 * (number - 1), m_Bytes[212] == 0x11);
  }

private:
  std::string m_Bytes;
};

/** ITK takes angstroms for millimetres, a map without a size of its cell for one with 1, bytes for unsigned
 *  ones, and every order of axes for the common one. */
void
CheckMrc(const std::filesystem::path & path, ItkScan & scan)
{
  const MrcHeader header(path);
  const auto      word = [&](std::size_t number) { return header.Word<std::int32_t>(number); };
  const auto      real = [&](std::size_t number) { return static_cast<double>(header.Word<float>(number)); };
  if (word(17) != 1 || word(18) != 2 || word(19) != 3)
  {
    RefuseInput(path,
                Text("its axes are stored in the order ", word(17), " ", word(18), " ", word(19), ", not 1 2 3"),
                "reorder them, with 'proc3d' or Chimera for example");
  }
  for (const std::size_t angle : { 14U, 15U, 16U })
  {
    if (real(angle) != 0 && !(std::abs(real(angle) - 90) < 1e-3))
    {
      RefuseInput(path,
                  Text("its cell has an angle of ", Number(real(angle)), " degrees"),
                  "resample it to a right-angled one");
    }
  }
  if (word(23) >= 401)
  {
    RefuseInput(path, "a stack of volumes (space group 401 or above)", "save one volume");
  }
  if (word(4) == 0)
  {
    // IMOD says itself; others follow the standard, which had unsigned bytes before 2014.
    const bool imod = word(39) == 1146047817;
    const bool isSigned = imod ? (word(40) & 1) != 0 : word(28) >= 20140;
    scan.type = isSigned ? PixelType::Int8 : PixelType::UInt8;
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double cell = real(11 + axis);
    const auto   samples = word(8 + axis);
    const double step = cell > 0 && samples > 0 ? cell / samples : 0;
    const double begin = real(50 + axis);
    const auto   start = word(5 + axis);
    scan.spacing[axis] = kMmInAngstrom * step;
    scan.origin[axis] = kMmInAngstrom * (begin != 0 ? begin : start * step);
  }
  scan.notes.push_back("lengths were converted to mm from angstroms");
  CheckLength(path, std::filesystem::file_size(path), 1024 + static_cast<std::uint64_t>(word(24)) + VolumeBytes(scan));
}

/** MINC has x to the right and y to the front, which ITK before 5.4 takes for LPS. */
void
CheckMinc(ItkScan & scan)
{
  for (Vector3 & axis : scan.axes)
  {
    axis = { -axis[0], -axis[1], axis[2] };
  }
  scan.origin = { -scan.origin[0], -scan.origin[1], scan.origin[2] };
  scan.notes.push_back("MINC's axes (right, front, up) were converted to LPS");
}

/** The bytes of a file, unpacked where it is packed by gzip. */
std::uint64_t
UnpackedLength(const std::filesystem::path & path, std::uint64_t enough)
{
  const gzFile file = gzopen(path.c_str(), "rb");
  if (file == nullptr)
  {
    RefuseInput(path, "cannot be opened", "check its name and permissions");
  }
  std::vector<char> buffer(1U << 20);
  std::uint64_t     length = 0;
  int               got = 1;
  while (length < enough && got > 0)
  {
    got = gzread(file, buffer.data(), static_cast<unsigned>(buffer.size()));
    length += static_cast<std::uint64_t>(std::max(0, got));
  }
  gzclose(file);
  return length;
}

std::string
UnpackedHeader(const std::filesystem::path & path, std::size_t count)
{
  std::string  header(count, '\0');
  const gzFile file = gzopen(path.c_str(), "rb");
  const int    got = file == nullptr ? 0 : gzread(file, header.data(), static_cast<unsigned>(count));
  if (file != nullptr)
  {
    gzclose(file);
  }
  header.resize(static_cast<std::size_t>(std::max(0, got)));
  return header;
}

/** ITK passes over a matrix and a scale of the values, and takes what is missing for anything. */
void
CheckGipl(const std::filesystem::path & path, ItkScan & scan)
{
  constexpr std::size_t length = 256;
  const std::string     header = UnpackedHeader(path, length);
  CheckLength(path, header.size(), length);
  const auto real = [&](std::size_t offset) { return static_cast<double>(At<float>(header, offset, true)); };
  bool       turned = false;
  for (std::size_t n = 0; n < 9; ++n)
  {
    const double part = real(106 + 4 * n);
    turned = turned || (part != 0 && part != (n % 4 == 0 ? 1.0 : 0.0));
  }
  if (turned)
  {
    RefuseInput(path, "its header has a matrix, which ITK passes over", "save it in ITK-SNAP as .nii.gz");
  }
  const double offset = real(236);
  const double scale = real(240);
  if (offset != 0 || (scale != 0 && scale != 1))
  {
    RefuseInput(path, "its header scales the values, which ITK passes over", "save it in ITK-SNAP as .nii.gz");
  }
  CheckLength(path, UnpackedLength(path, length + VolumeBytes(scan)), length + VolumeBytes(scan));
}

/** The header of a legacy VTK file, line by line. */
struct VtkHeader
{
  bool          isText = false;
  std::string   dataset;
  std::string   attribute; ///< "POINT_DATA" or "CELL_DATA"
  std::int64_t  count = 0; ///< of points
  std::string   array;     ///< "SCALARS", "COLOR_SCALARS", ...
  std::uint64_t end = 0;
};

VtkHeader
ReadVtkHeader(const std::filesystem::path & path)
{
  std::ifstream file(path, std::ios::binary);
  VtkHeader     header;
  std::string   line;
  for (int number = 0; number < 64 && std::getline(file, line) && line.size() < 4096; ++number)
  {
    const auto        words = Words(Trim(line));
    const std::string key = words.empty() ? std::string() : std::string(words[0]);
    const std::string next = words.size() < 2 ? std::string() : std::string(words[1]);
    if (number == 2)
    {
      header.isText = key == "ASCII";
    }
    else if (number > 2 && key == "DATASET")
    {
      header.dataset = next;
    }
    else if (key == "POINT_DATA" || key == "CELL_DATA")
    {
      header.attribute = key;
      header.count = ParseInteger(next).value_or(0);
    }
    else if (!header.attribute.empty() && !key.empty())
    {
      if (header.array == "SCALARS" && key != "LOOKUP_TABLE")
      {
        break;
      }
      header.array = header.array.empty() ? key : header.array;
      header.end = static_cast<std::uint64_t>(file.tellg());
      if (key == "LOOKUP_TABLE" || header.array != "SCALARS")
      {
        break;
      }
    }
  }
  return header;
}

/** As many numbers as there are voxels must follow in a text file. Returns where they end. */
std::uint64_t
CheckVtkText(const std::filesystem::path & path, const VtkHeader & header, std::uint64_t count)
{
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(header.end));
  std::string word;
  for (std::uint64_t n = 0; n < count; ++n)
  {
    if (!(file >> word) || !ParseReals(word))
    {
      RefuseInput(path, Text("it has ", n, " of ", count, " numbers"), "it is truncated or damaged: write it anew");
    }
  }
  return file.eof() ? std::filesystem::file_size(path) : static_cast<std::uint64_t>(file.tellg());
}

/** Whether another array begins soon behind the first. */
bool
HasMoreArrays(const std::filesystem::path & path, std::uint64_t end)
{
  std::ifstream file(path, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(end));
  std::string word;
  for (int n = 0; n < 64 && file >> word; ++n)
  {
    if (word.ends_with("SCALARS") || word == "VECTORS" || word == "FIELD" || word == "TENSORS" || word == "NORMALS")
    {
      return true;
    }
  }
  return false;
}

/** ITK takes values of cells for those of points, colours in text for fractions, and what is missing for anything. */
void
CheckVtk(const std::filesystem::path & path, ItkScan & scan)
{
  const VtkHeader     header = ReadVtkHeader(path);
  const std::uint64_t bytes = VolumeBytes(scan);
  const std::uint64_t voxels = bytes / PixelBytes(scan.type) / scan.components;
  if (header.dataset != "STRUCTURED_POINTS")
  {
    RefuseInput(path, Text("a VTK file of ", Printable(header.dataset, 30)), "save it as STRUCTURED_POINTS");
  }
  if (header.attribute != "POINT_DATA" || header.count != static_cast<std::int64_t>(voxels))
  {
    RefuseInput(path,
                header.attribute == "CELL_DATA" ? "values of cells, not of points"
                                                : "not as many values as its DIMENSIONS say",
                "save it in ParaView with point data, as Meta Image .mhd");
  }
  if (header.array != "SCALARS" && !(header.array == "COLOR_SCALARS" && !header.isText))
  {
    RefuseInput(path,
                Text(Printable(header.array, 20), header.isText ? " as text" : "", " for values"),
                "SCALARS are needed: save it in ParaView as Meta Image .mhd");
  }
  if (scan.components > 1)
  {
    RefuseInput(path, Text(scan.components, " values a voxel"), "save it with one whole number a voxel");
  }
  const std::uint64_t end = header.isText ? CheckVtkText(path, header, voxels) : header.end + bytes;
  CheckLength(path, std::filesystem::file_size(path), end);
  if (HasMoreArrays(path, end))
  {
    scan.warnings.push_back("the file holds several arrays; the first is read");
  }
  scan.notes.push_back("VTK does not say where its axes run to; they are taken as LPS, in mm");
}

} // namespace

void
CheckBeforeItk(const std::filesystem::path & path, ItkFormat format)
{
  if (format == ItkFormat::Mrc)
  {
    const std::int64_t extended = MrcHeader(path).Word<std::int32_t>(24);
    if (extended < 0 || extended > static_cast<std::int64_t>(std::filesystem::file_size(path)) - 1024)
    {
      RefuseInput(path,
                  Text("its header says that ", extended, " bytes of another header follow"),
                  "the file is damaged: fetch or write it anew");
    }
  }
}

void
CheckHeader(const std::filesystem::path & path, ItkFormat format, ItkScan & scan)
{
  switch (format)
  {
    case ItkFormat::Mrc:
      return CheckMrc(path, scan);
    case ItkFormat::Minc:
      return CheckMinc(scan);
    case ItkFormat::Gipl:
      return CheckGipl(path, scan);
    case ItkFormat::Vtk:
      return CheckVtk(path, scan);
    default:
      return;
  }
}

} // namespace voxelcore::itkreader
