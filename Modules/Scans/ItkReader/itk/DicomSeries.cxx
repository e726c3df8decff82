// A series of slices, a file each, and the choice of what a file or a folder holds.

#include "DicomFields.h"
#include "DicomOpeners.h"
#include "DicomPixels.h"
#include "DicomPlanes.h"
#include "voxelcore/Base/TextFields.h"

#include <gdcmReader.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <numeric>

namespace voxelcore::itkreader
{
namespace
{

constexpr const char * kSegmentation = "1.2.840.10008.5.1.4.1.1.66.4";
constexpr const char * kLabelMap = "1.2.840.10008.5.1.4.1.1.66.7";
constexpr const char * kContours = "1.2.840.10008.5.1.4.1.1.481.3";

const gdcm::Tag kClass(0x0008, 0x0016);
const gdcm::Tag kSeries(0x0020, 0x000e);

/** The data set up to the pixels. False for a file that is no DICOM. */
bool
ReadHeader(const std::filesystem::path & path, gdcm::Reader & reader)
{
  reader.SetFileName(path.c_str());
  return reader.ReadUpToTag(gdcm::Tag(0x7fe0, 0x0010)) && !reader.GetFile().GetDataSet().IsEmpty();
}

struct SliceFile
{
  std::filesystem::path path;
  DicomPixels           pixels;
  DicomPlane            plane;
  double                instance = 0;
};

class SeriesSource : public ScanSource
{
public:
  SeriesSource(const std::filesystem::path & path, const std::vector<std::filesystem::path> & files)
  {
    for (const auto & file : files)
    {
      gdcm::Reader reader;
      ReadHeader(file, reader);
      const gdcm::DataSet & set = reader.GetFile().GetDataSet();
      SliceFile             slice{ file, DescribePixels(file, set), {}, 0 };
      TakePlaneFields(set, slice.plane);
      slice.instance = FieldReal(set, gdcm::Tag(0x0020, 0x0013)).value_or(0);
      m_Files.push_back(std::move(slice));
    }
    const DicomPixels & first = m_Files.front().pixels;
    for (const SliceFile & slice : m_Files)
    {
      const DicomPixels & pixels = slice.pixels;
      if (pixels.frames != 1 || pixels.bitsAllocated == 1)
      {
        RefuseInput(slice.path, "a file of many frames among slices", "name that file");
      }
      if (pixels.rows != first.rows || pixels.columns != first.columns || pixels.Type() != first.Type())
      {
        RefuseInput(slice.path,
                    Text("this slice (",
                         pixels.columns,
                         " x ",
                         pixels.rows,
                         ", ",
                         PixelName(pixels.Type()),
                         ") is not like the first (",
                         first.columns,
                         " x ",
                         first.rows,
                         ", ",
                         PixelName(first.Type()),
                         ")"),
                    "a volume needs equal slices");
      }
      m_OneScale = m_OneScale && pixels.slope == first.slope && pixels.intercept == first.intercept;
    }
    Describe(path);
  }

  void
  Send(std::uint64_t volume, std::uint64_t, const Sink & sink) override
  {
    for (const auto & place : m_Stack.slices)
    {
      const SliceFile &       slice = m_Files[place.at(volume)];
      const std::vector<char> bytes = ReadPixels(slice.path, slice.pixels);
      if (m_OneScale)
      {
        sink(bytes.data(), bytes.size());
        continue;
      }
      const std::size_t   width = PixelBytes(slice.pixels.Type());
      std::vector<double> values(slice.pixels.FrameValues());
      for (std::size_t n = 0; n < values.size(); ++n)
      {
        const auto * at = reinterpret_cast<const std::byte *>(bytes.data() + n * width);
        values[n] = slice.pixels.slope * StoredValue(at, slice.pixels.Type()) + slice.pixels.intercept;
      }
      sink(reinterpret_cast<const char *>(values.data()), values.size() * sizeof(double));
    }
  }

private:
  void
  Describe(const std::filesystem::path & path)
  {
    const DicomPixels & first = m_Files.front().pixels;
    scan.format = "DICOM";
    scan.notes.push_back("read by " + GdcmName());
    std::stable_sort(m_Files.begin(), m_Files.end(), [](const SliceFile & a, const SliceFile & b) {
      return a.instance < b.instance;
    });
    std::vector<DicomPlane> planes;
    for (const SliceFile & slice : m_Files)
    {
      planes.push_back(slice.plane);
      scan.files.push_back(slice.path);
    }
    m_Stack = StackPlanes(path, planes, false, scan);
    if (m_Stack.slices.size() == 1 && m_Files.size() > 1)
    {
      RefuseInput(path, Text(m_Files.size(), " slices at one place"), "give the folder of one volume");
    }
    for (const auto & place : m_Stack.slices)
    {
      if (place.size() != m_Stack.slices.front().size())
      {
        RefuseInput(path,
                    "not as many slices at each place",
                    "keep the slices of one volume in one series, without doubles");
      }
    }
    scan.volumes = m_Stack.slices.front().size();
    if (scan.volumes > 1)
    {
      scan.notes.push_back("slices at one place are volumes in the order of their instance numbers");
    }
    scan.size[0] = first.columns;
    scan.size[1] = first.rows;
    scan.storedType = PixelName(first.Type());
    scan.type = m_OneScale ? first.Type() : PixelType::Float64;
    if (m_OneScale)
    {
      scan.slope = first.slope;
      scan.intercept = first.intercept;
    }
    else
    {
      scan.notes.push_back("slices have slopes of their own");
    }
  }

  std::vector<SliceFile> m_Files;
  PlaneStack             m_Stack;
  bool                   m_OneScale = true;
};

/** Files of a folder that are DICOM, by their series, in natural order of nothing: by name. */
std::map<std::string, std::vector<std::filesystem::path>>
SeriesIn(const std::filesystem::path & folder)
{
  std::vector<std::filesystem::path> files;
  for (const auto & entry : std::filesystem::directory_iterator(folder))
  {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file() && !name.starts_with('.') && name != "DICOMDIR")
    {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  std::map<std::string, std::vector<std::filesystem::path>> series;
  for (const auto & file : files)
  {
    gdcm::Reader reader;
    if (ReadHeader(file, reader))
    {
      series[FieldText(reader.GetFile().GetDataSet(), kSeries)].push_back(file);
    }
  }
  return series;
}

[[noreturn]] void
RefuseSeveral(const std::filesystem::path &                                     folder,
              const std::map<std::string, std::vector<std::filesystem::path>> & series)
{
  std::string list;
  std::size_t shown = 0;
  for (const auto & [uid, files] : series)
  {
    if (++shown > 6)
    {
      list += ", ...";
      break;
    }
    gdcm::Reader reader;
    ReadHeader(files.front(), reader);
    const std::string what = FieldText(reader.GetFile().GetDataSet(), gdcm::Tag(0x0008, 0x103e));
    list += Text(list.empty() ? "" : ", ",
                 "'",
                 Printable(files.front().filename().string()),
                 "' (",
                 what.empty() ? "" : Printable(what, 40) + ", ",
                 Counted(files.size(), "file", "files"),
                 ")");
  }
  RefuseInput(folder, Text(series.size(), " series, beginning with ", list), "name a file of the one to read");
}

/** A file by itself. Null where it is a slice. */
std::unique_ptr<ScanSource>
OpenAlone(const std::filesystem::path & path)
{
  gdcm::Reader reader;
  if (!ReadHeader(path, reader))
  {
    RefuseInput(path, "GDCM cannot read it", "the file is damaged or no DICOM");
  }
  const gdcm::DataSet & set = reader.GetFile().GetDataSet();
  const std::string     kind = FieldText(set, kClass);
  if (kind == kContours)
  {
    RefuseInput(path, "DICOM contours (RTSTRUCT), not read", "load them in 3D Slicer (SlicerRT) and save .seg.nrrd");
  }
  if (kind == kSegmentation || kind == kLabelMap)
  {
    return OpenSegmentation(path, set);
  }
  return DescribePixels(path, set).frames > 1 || set.FindDataElement(gdcm::Tag(0x5200, 0x9230)) ? OpenFrames(path, set)
                                                                                                : nullptr;
}

} // namespace

std::unique_ptr<ScanSource>
OpenSeries(const std::filesystem::path & path, const std::vector<std::filesystem::path> & files)
{
  return std::make_unique<SeriesSource>(path, files);
}

std::unique_ptr<ScanSource>
OpenDicom(const std::filesystem::path & path)
{
  if (std::filesystem::is_directory(path))
  {
    const auto series = SeriesIn(path);
    if (series.empty())
    {
      RefuseInput(path, "no DICOM file in this folder that GDCM can read", "check the name");
    }
    if (series.size() > 1)
    {
      RefuseSeveral(path, series);
    }
    const auto & files = series.begin()->second;
    auto         alone = files.size() == 1 ? OpenAlone(files.front()) : nullptr;
    return alone ? std::move(alone) : OpenSeries(path, files);
  }
  if (auto alone = OpenAlone(path))
  {
    return alone;
  }
  gdcm::Reader reader;
  ReadHeader(path, reader);
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  return OpenSeries(path, SeriesIn(folder)[FieldText(reader.GetFile().GetDataSet(), kSeries)]);
}

} // namespace voxelcore::itkreader
