// DICOM segmentations (PS3.3 C.8.20, C.8.37 label maps): a frame a segment and place, or labels.

#include "DicomFields.h"
#include "DicomFrames.h"
#include "DicomOpeners.h"
#include "DicomPixels.h"
#include "voxelcore/Base/TextFields.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <numeric>
#include <set>

namespace voxelcore::itkreader
{
namespace
{

enum class Kind : std::uint8_t
{
  Binary,
  Fractional,
  LabelMap
};

/** Recommended Display CIELab Value as dcmqi writes it and Slicer shows it: of white D65, to sRGB. */
std::optional<Color>
ColorOf(const gdcm::DataSet & item)
{
  const auto values = FieldShorts(item, gdcm::Tag(0x0062, 0x000d));
  if (values.size() != 3)
  {
    return std::nullopt;
  }
  const double lightness = values[0] / 65535.0 * 100;
  const double a = values[1] / 65535.0 * 255 - 128;
  const double b = values[2] / 65535.0 * 255 - 128;
  const double fy = (lightness + 16) / 116;
  const auto   part = [](double f) { return f * f * f > 0.008856 ? f * f * f : (f - 16.0 / 116) / 7.787; };
  const double x = 0.950456 * part(fy + a / 500);
  const double y = part(fy);
  const double z = 1.088754 * part(fy - b / 200);
  const auto   curved = [](double linear) {
    const double value = linear > 0.0031308 ? 1.055 * std::pow(linear, 1 / 2.4) - 0.055 : 12.92 * linear;
    return std::clamp(value, 0.0, 1.0);
  };
  return Color{ curved(3.240479 * x - 1.537150 * y - 0.498535 * z),
                curved(-0.969256 * x + 1.875992 * y + 0.041556 * z),
                curved(0.055648 * x - 0.204043 * y + 1.057311 * z) };
}

/** Segments in the order of the file. */
std::vector<Segment>
ReadSegments(const std::filesystem::path & path, const gdcm::DataSet & set, bool isLabelMap)
{
  std::vector<Segment>   segments;
  std::set<std::int64_t> numbers;
  const std::string      characters = FieldText(set, gdcm::Tag(0x0008, 0x0005));
  const auto             sequence = FieldSequence(set, gdcm::Tag(0x0062, 0x0002));
  for (std::size_t n = 1; sequence && n <= sequence->GetNumberOfItems(); ++n)
  {
    const gdcm::DataSet & item = sequence->GetItem(n).GetNestedDataSet();
    Segment               segment;
    segment.value = FieldShort(item, gdcm::Tag(0x0062, 0x0004)).value_or(0);
    segment.name = Printable(FieldName(item, gdcm::Tag(0x0062, 0x0005), characters), 200);
    segment.color = ColorOf(item);
    if (segment.value == 0 && isLabelMap)
    {
      continue; // the background may be described
    }
    if (segment.value == 0 || !numbers.insert(segment.value).second)
    {
      RefuseInput(path,
                  Text("two segments or none have the number ", segment.value),
                  "the file is damaged: write it anew");
    }
    segments.push_back(std::move(segment));
  }
  if (segments.empty())
  {
    RefuseInput(path, "a segmentation without segments", "the file is damaged: write it anew");
  }
  return segments;
}

class SegmentationSource : public ScanSource
{
public:
  SegmentationSource(const std::filesystem::path & path, const gdcm::DataSet & set)
    : m_Path(path)
    , m_Pixels(DescribePixels(path, set))
  {
    const std::string kind = FieldText(set, gdcm::Tag(0x0062, 0x0001));
    if (kind != "BINARY" && kind != "FRACTIONAL" && kind != "LABELMAP")
    {
      RefuseInput(path,
                  Text("a segmentation of type '", Printable(kind, 20), "'"),
                  "save it as BINARY, FRACTIONAL or LABELMAP");
    }
    m_Kind = kind == "BINARY" ? Kind::Binary : kind == "FRACTIONAL" ? Kind::Fractional : Kind::LabelMap;
    if (m_Kind == Kind::Binary ? m_Pixels.bitsAllocated != 1
                               : m_Pixels.bitsAllocated < 8 || m_Pixels.isSigned ||
                                   (m_Kind == Kind::Fractional && m_Pixels.bitsAllocated != 8))
    {
      RefuseInput(path,
                  Text(kind, " segmentation with pixels of ", m_Pixels.bitsAllocated, " bits"),
                  "it is damaged: write it anew");
    }
    m_Segments = ReadSegments(path, set, m_Kind == Kind::LabelMap);
    scan.format = "DICOM-SEG";
    scan.files = { path };
    scan.notes.push_back("read by " + GdcmName());
    scan.size[0] = m_Pixels.columns;
    scan.size[1] = m_Pixels.rows;
    Arrange(ReadFrames(path, set, m_Pixels));
    if (m_Kind == Kind::Fractional)
    {
      DescribeFractions(set);
    }
    else if (m_Kind == Kind::Binary)
    {
      m_Data = ReadPixels(path, m_Pixels);
      ChooseLayers();
    }
    else
    {
      scan.type = m_Pixels.Type();
      scan.storedType = PixelName(scan.type);
      scan.segments = m_Segments;
    }
  }

  void
  Send(std::uint64_t, std::uint64_t component, const Sink & sink) override
  {
    if (m_Data.empty())
    {
      m_Data = ReadPixels(m_Path, m_Pixels);
    }
    const std::size_t pixels = m_Pixels.FrameValues();
    const std::size_t width = PixelBytes(scan.type);
    std::vector<char> slice(pixels * width * (m_Kind == Kind::Binary ? scan.components : 1));
    for (std::size_t k = 0; k < m_FrameOf.size(); ++k)
    {
      std::fill(slice.begin(), slice.end(), '\0');
      if (m_Kind == Kind::Binary)
      {
        for (std::size_t s = 0; s < m_Segments.size(); ++s)
        {
          PaintBits(k, s, slice);
        }
      }
      else if (const auto frame = m_FrameOf[k][m_Kind == Kind::Fractional ? component : 0]; frame >= 0)
      {
        const auto begin = m_Data.begin() + static_cast<std::ptrdiff_t>(frame * m_Pixels.FrameBytes());
        std::copy(begin, begin + static_cast<std::ptrdiff_t>(m_Pixels.FrameBytes()), slice.begin());
      }
      sink(slice.data(), slice.size());
    }
  }

private:
  /** Which frame each place and segment has. */
  void
  Arrange(const std::vector<DicomFrame> & frames)
  {
    std::vector<DicomPlane> planes;
    for (const DicomFrame & frame : frames)
    {
      planes.push_back(frame.plane);
    }
    const PlaneStack                     stack = StackPlanes(m_Path, planes, true, scan);
    std::map<std::uint16_t, std::size_t> placeOf;
    for (std::size_t s = 0; s < m_Segments.size(); ++s)
    {
      placeOf[static_cast<std::uint16_t>(m_Segments[s].value)] = s;
    }
    const std::size_t columns = m_Kind == Kind::LabelMap ? 1 : m_Segments.size();
    std::size_t       empty = 0;
    for (const auto & slice : stack.slices)
    {
      std::vector<std::ptrdiff_t> row(columns, -1);
      for (const std::size_t frame : slice)
      {
        const auto place = placeOf.find(frames[frame].segment);
        if (m_Kind != Kind::LabelMap && place == placeOf.end())
        {
          RefuseInput(m_Path,
                      Text("frame ", frame + 1, " is of segment ", frames[frame].segment, ", which is not there"),
                      "the file is damaged: write it anew");
        }
        std::ptrdiff_t & at = row[m_Kind == Kind::LabelMap ? 0 : place->second];
        if (at >= 0)
        {
          RefuseInput(m_Path,
                      Text("frames ", at + 1, " and ", frame + 1, " are of one segment at one place"),
                      "a segmentation of a series in time: save one of its volumes");
        }
        at = static_cast<std::ptrdiff_t>(frame);
      }
      empty += slice.empty() ? 1 : 0;
      m_FrameOf.push_back(std::move(row));
    }
    if (empty > 0)
    {
      scan.notes.push_back(Text(Counted(empty, "slice", "slices"), " without a frame are background"));
    }
  }

  void
  DescribeFractions(const gdcm::DataSet & set)
  {
    const auto most = FieldShort(set, gdcm::Tag(0x0062, 0x000e)).value_or(0);
    if (most < 1 || most > 255)
    {
      RefuseInput(m_Path,
                  Text("fractions of ", most, " (Maximum Fractional Value)"),
                  "the file is damaged: write it anew");
    }
    scan.type = PixelType::UInt8;
    scan.storedType = "uint8";
    scan.slope = 1.0 / most;
    scan.components = m_Segments.size();
    scan.separate = true;
    const std::string what = LowerCase(FieldText(set, gdcm::Tag(0x0062, 0x0010)));
    std::string       names;
    for (std::size_t s = 0; s < m_Segments.size() && s < 8; ++s)
    {
      names += Text(names.empty() ? "" : ", ", s, " ", m_Segments[s].name);
    }
    scan.notes.push_back(Text("fractions from 0 to 1",
                              what.empty() ? "" : " (" + Printable(what, 20) + ")",
                              "; choose with --threshold, such as 0.5:1; components: ",
                              names));
  }

  bool
  Bit(std::size_t index) const
  {
    return (static_cast<unsigned char>(m_Data[index / 8]) >> (index % 8) & 1U) != 0;
  }

  bool
  FramesOverlap(std::ptrdiff_t a, std::ptrdiff_t b) const
  {
    const std::size_t pixels = m_Pixels.FrameValues();
    const std::size_t first = static_cast<std::size_t>(a) * pixels;
    const std::size_t second = static_cast<std::size_t>(b) * pixels;
    if (pixels % 8 == 0) // frames begin with a byte
    {
      const auto at = m_Data.begin() + static_cast<std::ptrdiff_t>(first / 8);
      return std::inner_product(at,
                                at + static_cast<std::ptrdiff_t>(pixels / 8),
                                m_Data.begin() + static_cast<std::ptrdiff_t>(second / 8),
                                0,
                                std::bit_or<int>(),
                                [](char x, char y) { return x & y; }) != 0;
    }
    for (std::size_t n = 0; n < pixels; ++n)
    {
      if (Bit(first + n) && Bit(second + n))
      {
        return true;
      }
    }
    return false;
  }

  bool
  Overlap(std::size_t a, std::size_t b) const
  {
    return std::any_of(m_FrameOf.begin(), m_FrameOf.end(), [&](const auto & row) {
      return row[a] >= 0 && row[b] >= 0 && FramesOverlap(row[a], row[b]);
    });
  }

  /** Segments that overlap get layers of their own. */
  void
  ChooseLayers()
  {
    std::int64_t                          largest = 0;
    std::vector<std::vector<std::size_t>> layers;
    for (std::size_t s = 0; s < m_Segments.size(); ++s)
    {
      const auto free = std::find_if(layers.begin(), layers.end(), [&](const auto & layer) {
        return std::none_of(layer.begin(), layer.end(), [&](std::size_t other) { return Overlap(s, other); });
      });
      m_Segments[s].layer = static_cast<std::size_t>(free - layers.begin());
      if (free == layers.end())
      {
        layers.emplace_back();
      }
      layers[m_Segments[s].layer].push_back(s);
      largest = std::max(largest, m_Segments[s].value);
    }
    if (layers.size() > 1)
    {
      scan.notes.push_back(Text("segments overlap; they are read in ", layers.size(), " layers"));
    }
    scan.type = largest < 256 ? PixelType::UInt8 : PixelType::UInt16;
    scan.storedType = "uint1";
    scan.components = layers.size();
    scan.segments = m_Segments;
  }

  void
  PaintBits(std::size_t k, std::size_t s, std::vector<char> & slice) const
  {
    const std::ptrdiff_t frame = m_FrameOf[k][s];
    if (frame < 0)
    {
      return;
    }
    const std::size_t pixels = m_Pixels.FrameValues();
    const std::size_t first = static_cast<std::size_t>(frame) * pixels;
    const std::size_t width = PixelBytes(scan.type);
    const auto        value = static_cast<std::uint16_t>(m_Segments[s].value);
    const auto        byte = static_cast<std::uint8_t>(value);
    for (std::size_t n = 0; n < pixels; ++n)
    {
      if (Bit(first + n))
      {
        std::memcpy(slice.data() + (n * scan.components + m_Segments[s].layer) * width,
                    width == 1 ? static_cast<const void *>(&byte) : &value,
                    width);
      }
    }
  }

  std::filesystem::path                    m_Path;
  DicomPixels                              m_Pixels;
  Kind                                     m_Kind = Kind::Binary;
  std::vector<Segment>                     m_Segments;
  std::vector<std::vector<std::ptrdiff_t>> m_FrameOf; ///< by place and segment; -1: none
  std::vector<char>                        m_Data;
};

} // namespace

std::unique_ptr<ScanSource>
OpenSegmentation(const std::filesystem::path & path, const gdcm::DataSet & set)
{
  return std::make_unique<SegmentationSource>(path, set);
}

} // namespace voxelcore::itkreader
