#include "voxelcore/Formats/VolumeWriters.h"

#include "NiftiForms.h"
#include "PackedFile.h"
#include "voxelcore/Base/TextFields.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <iomanip>

namespace voxelcore
{
namespace
{

// Labels of one byte are runs of equal bytes: looking for nothing else takes half the time. One label takes less room
// so, many up to 40 % more.
int
Strategy(const VolumeToWrite & volume)
{
  return PixelBytes(volume.type) == 1 && volume.layers == 1 ? Z_RLE : Z_DEFAULT_STRATEGY;
}

void
WriteSlices(PackedFile & file, const VolumeToWrite & volume)
{
  for (std::int64_t k = 0; k < volume.geometry.size[2]; ++k)
  {
    file.Write(volume.slice(k));
  }
}

/** All digits: what is read back is what was written. */
std::string
Exact(double value)
{
  return Text(std::setprecision(17), value);
}

constexpr bool kBigEndian = std::endian::native == std::endian::big;

/** Quaternion b, c, d of a rotation given by columns, as nifti_mat44_to_quatern computes it. */
std::array<double, 3>
QuaternionOf(const std::array<Vector3, 3> & axes)
{
  const auto            r = [&axes](std::size_t row, std::size_t column) { return axes[column][row]; };
  double                a = r(0, 0) + r(1, 1) + r(2, 2) + 1;
  std::array<double, 3> q{};
  if (a > 0.5)
  {
    a = 0.5 * std::sqrt(a);
    return { 0.25 * (r(2, 1) - r(1, 2)) / a, 0.25 * (r(0, 2) - r(2, 0)) / a, 0.25 * (r(1, 0) - r(0, 1)) / a };
  }
  // Near a half turn: divide by the largest of b, c, d.
  std::size_t i = 0;
  for (std::size_t k = 1; k < 3; ++k)
  {
    i = r(k, k) > r(i, i) ? k : i;
  }
  const std::size_t j = (i + 1) % 3;
  const std::size_t k = (i + 2) % 3;
  q[i] = 0.5 * std::sqrt(1 + r(i, i) - r(j, j) - r(k, k));
  q[j] = 0.25 * (r(i, j) + r(j, i)) / q[i];
  q[k] = 0.25 * (r(i, k) + r(k, i)) / q[i];
  a = 0.25 * (r(k, j) - r(j, k)) / q[i];
  if (a < 0)
  {
    q = { -q[0], -q[1], -q[2] };
  }
  return q;
}

class NiftiBytes
{
public:
  template <typename T>
  void
  Put(std::size_t at, T value)
  {
    std::memcpy(m_Bytes.data() + at, &value, sizeof value);
  }
  std::span<const std::byte>
  Bytes() const
  {
    return m_Bytes;
  }

private:
  std::array<std::byte, 352> m_Bytes{};
};

/** The format knows int8 and uint32, but no float32. */
std::string
NrrdTypeName(PixelType type)
{
  return type == PixelType::Float32 ? "float" : type == PixelType::Float64 ? "double" : PixelName(type);
}

} // namespace

void
WriteNrrd(const std::filesystem::path & path, const VolumeToWrite & volume)
{
  const ImageGeometry & g = volume.geometry;
  const auto            vector = [](double x, double y, double z) {
    return Text("(", Exact(x), ",", Exact(y), ",", Exact(z), ")");
  };
  std::string directions;
  for (std::size_t a = 0; a < 3; ++a)
  {
    directions +=
      Text(" ",
           vector(g.direction[a] * g.spacing[a], g.direction[3 + a] * g.spacing[a], g.direction[6 + a] * g.spacing[a]));
  }
  PackedFile file(path, volume.compress ? Wrapping::Gzip : Wrapping::None, Strategy(volume));
  file.WritePlain(
    Text("NRRD0004\n# Complete NRRD file format specification at:\n"
         "# http://teem.sourceforge.net/nrrd/format.html\n",
         "type: ",
         NrrdTypeName(volume.type),
         volume.layers > 1 ? "\ndimension: 4" : "\ndimension: 3",
         "\nspace: left-posterior-superior\n",
         "sizes: ",
         volume.layers > 1 ? Text(volume.layers, " ") : "",
         g.size[0],
         " ",
         g.size[1],
         " ",
         g.size[2],
         "\nspace directions:",
         volume.layers > 1 ? " none" : "",
         directions,
         g.unit == SpatialUnit::Voxels ? "\nspace units: \"voxel\" \"voxel\" \"voxel\"" : "",
         volume.layers > 1 ? "\nkinds: list domain domain domain" : "\nkinds: domain domain domain",
         "\nendian: ",
         kBigEndian ? "big" : "little",
         "\nencoding: ",
         volume.compress ? "gzip" : "raw",
         "\nspace origin: ",
         vector(g.origin[0], g.origin[1], g.origin[2]),
         "\n",
         volume.fields,
         "\n"));
  WriteSlices(file, volume);
  file.Close();
}

void
WriteNifti(const std::filesystem::path & path, const VolumeToWrite & volume)
{
  const ImageGeometry & g = volume.geometry;
  NiftiBytes            h;
  h.Put(0, std::int32_t{ 348 });
  h.Put(38, 'r');
  h.Put(40, std::int16_t{ 3 });
  // LPS -> RAS.
  constexpr Vector3      sign{ -1, -1, 1 };
  std::array<Vector3, 3> axes{};
  for (std::size_t a = 0; a < 3; ++a)
  {
    h.Put(42 + 2 * a, static_cast<std::int16_t>(g.size[a]));
    h.Put(80 + 4 * a, static_cast<float>(g.spacing[a]));
    h.Put(268 + 4 * a, static_cast<float>(sign[a] * g.origin[a]));
    for (std::size_t row = 0; row < 3; ++row)
    {
      axes[a][row] = sign[row] * g.direction[3 * row + a];
      h.Put(280 + 16 * row + 4 * a, static_cast<float>(axes[a][row] * g.spacing[a]));
    }
    h.Put(280 + 16 * a + 12, static_cast<float>(sign[a] * g.origin[a]));
  }
  for (std::size_t unused = 4; unused < 8; ++unused)
  {
    h.Put(40 + 2 * unused, std::int16_t{ 1 });
    h.Put(76 + 4 * unused, 1.0F);
  }
  const std::array<std::int16_t, 9> codes{ 2, 0, 512, 0, 768, 0, 1280, 0, 16 }; // by PixelType, those that are written
  h.Put(70, codes[static_cast<std::size_t>(volume.type)]);
  h.Put(72, static_cast<std::int16_t>(8 * PixelBytes(volume.type)));
  const bool leftHanded = IsLeftHanded(g);
  if (leftHanded)
  {
    axes[2] = { -axes[2][0], -axes[2][1], -axes[2][2] };
  }
  h.Put(76, leftHanded ? -1.0F : 1.0F);
  h.Put(108, 352.0F);
  h.Put(112, 1.0F);
  if (g.unit == SpatialUnit::Voxels)
  {
    for (std::size_t i = 0; i < kNiftiInVoxels.size(); ++i)
    {
      h.Put(148 + i, kNiftiInVoxels[i]);
    }
  }
  else
  {
    h.Put(123, std::int8_t{ 2 }); // mm
  }
  h.Put(252, std::int16_t{ 1 });
  h.Put(254, std::int16_t{ 1 });
  const auto quaternion = QuaternionOf(axes);
  for (std::size_t i = 0; i < 3; ++i)
  {
    h.Put(256 + 4 * i, static_cast<float>(quaternion[i]));
  }
  h.Put(344, std::array<char, 4>{ 'n', '+', '1', '\0' });

  PackedFile file(path, LowerCase(path.string()).ends_with(".gz") ? Wrapping::Gzip : Wrapping::None, Strategy(volume));
  file.Write(h.Bytes());
  WriteSlices(file, volume);
  file.Close();
}

void
WriteMetaImage(const std::filesystem::path & path, const VolumeToWrite & volume)
{
  const ImageGeometry & g = volume.geometry;
  const Wrapping        wrapping = volume.compress ? Wrapping::Zlib : Wrapping::None;
  auto                  dataPath = path;
  dataPath.replace_extension(volume.compress ? ".zraw" : ".raw");
  // Programs want the packed size in the header, so the voxels go into a file of their own first.
  PackedFile data(dataPath, wrapping, Strategy(volume));
  WriteSlices(data, volume);
  const std::uint64_t bytes = data.Close();

  std::string matrix;
  for (std::size_t a = 0; a < 3; ++a)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      matrix += Text(" ", Exact(g.direction[3 * c + a]));
    }
  }
  const auto numbers = [](const Vector3 & v) { return Text(Exact(v[0]), " ", Exact(v[1]), " ", Exact(v[2])); };
  const std::array<const char *, 9> types{ "MET_UCHAR",      "", "MET_USHORT", "", "MET_UINT", "",
                                           "MET_ULONG_LONG", "", "MET_FLOAT" };
  const bool                        local = LowerCase(path.extension().string()) == ".mha";
  PackedFile                        file(path, Wrapping::None);
  file.WritePlain(Text("ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = ",
                       kBigEndian ? "True" : "False",
                       "\nCompressedData = ",
                       volume.compress ? "True" : "False",
                       volume.compress ? Text("\nCompressedDataSize = ", bytes) : "",
                       "\nTransformMatrix =",
                       matrix,
                       "\nOffset = ",
                       numbers(g.origin),
                       "\nCenterOfRotation = 0 0 0\nElementSpacing = ",
                       numbers(g.spacing),
                       g.unit == SpatialUnit::Voxels ? "\nDistanceUnits = voxel" : "",
                       "\nDimSize = ",
                       g.size[0],
                       " ",
                       g.size[1],
                       " ",
                       g.size[2],
                       "\nElementType = ",
                       types[static_cast<std::size_t>(volume.type)],
                       "\nElementDataFile = ",
                       local ? "LOCAL" : dataPath.filename().string(),
                       "\n"));
  if (local)
  {
    const auto             stream = OpenBytes(dataPath, 0, Packing::Plain);
    std::vector<std::byte> part(1U << 20);
    for (std::uint64_t left = bytes; left > 0;)
    {
      const auto now = static_cast<std::size_t>(std::min<std::uint64_t>(left, part.size()));
      stream->Read(part.data(), now);
      file.Write(std::span(part).first(now));
      left -= now;
    }
    std::filesystem::remove(dataPath);
  }
  file.Close();
}

} // namespace voxelcore
