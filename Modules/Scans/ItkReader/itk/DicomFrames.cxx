// Images of many frames: enhanced CT and MR, and what segmentations share with them.

#include "DicomFrames.h"

#include "DicomFields.h"
#include "DicomOpeners.h"
#include "voxelcore/Base/TextFields.h"

#include <algorithm>
#include <cstring>

namespace voxelcore::itkreader
{
namespace
{

void
TakeGroups(const gdcm::DataSet & groups, DicomFrame & frame)
{
  for (const gdcm::Tag & tag : { gdcm::Tag(0x0020, 0x9113),   // Plane Position Sequence
                                 gdcm::Tag(0x0020, 0x9116),   // Plane Orientation Sequence
                                 gdcm::Tag(0x0028, 0x9110) }) // Pixel Measures Sequence
  {
    if (const auto item = FirstItem(groups, tag))
    {
      TakePlaneFields(*item, frame.plane);
    }
  }
  if (const auto item = FirstItem(groups, gdcm::Tag(0x0028, 0x9145))) // Pixel Value Transformation Sequence
  {
    DicomPixels scale{ .slope = frame.slope, .intercept = frame.intercept };
    TakeRescale(*item, scale);
    frame.slope = scale.slope;
    frame.intercept = scale.intercept;
  }
  if (const auto item = FirstItem(groups, gdcm::Tag(0x0062, 0x000a))) // Segment Identification Sequence
  {
    frame.segment = FieldShort(*item, gdcm::Tag(0x0062, 0x000b)).value_or(0);
  }
}

class FramesSource : public ScanSource
{
public:
  FramesSource(const std::filesystem::path & path, const gdcm::DataSet & set)
    : m_Path(path)
    , m_Pixels(DescribePixels(path, set))
  {
    const std::vector<DicomFrame> frames = ReadFrames(path, set, m_Pixels);
    std::vector<DicomPlane>       planes;
    for (const DicomFrame & frame : frames)
    {
      planes.push_back(frame.plane);
      m_Scales.emplace_back(frame.slope, frame.intercept);
    }
    if (m_Pixels.bitsAllocated == 1)
    {
      RefuseInput(path, "an image of bits that is no segmentation", "load it in 3D Slicer and save it as .nrrd");
    }
    scan.format = "DICOM";
    scan.files = { path };
    scan.notes.push_back("read by " + GdcmName());
    m_Stack = StackPlanes(path, planes, false, scan);
    for (const auto & slice : m_Stack.slices)
    {
      if (slice.size() != m_Stack.slices.front().size())
      {
        RefuseInput(path, "not as many frames at each place", "load it in 3D Slicer and save it as .nrrd");
      }
    }
    scan.volumes = m_Stack.slices.front().size();
    scan.size[0] = m_Pixels.columns;
    scan.size[1] = m_Pixels.rows;
    scan.storedType = PixelName(m_Pixels.Type());
    m_OneScale =
      std::all_of(m_Scales.begin(), m_Scales.end(), [this](const auto & scale) { return scale == m_Scales.front(); });
    if (m_OneScale)
    {
      scan.type = m_Pixels.Type();
      scan.slope = m_Scales.front().first;
      scan.intercept = m_Scales.front().second;
    }
    else
    {
      scan.type = PixelType::Float64;
      scan.notes.push_back("frames have slopes of their own");
    }
  }

  void
  Send(std::uint64_t volume, std::uint64_t, const Sink & sink) override
  {
    const std::vector<char> pixels = ReadPixels(m_Path, m_Pixels);
    std::vector<double>     scaled(m_OneScale ? 0 : m_Pixels.FrameValues());
    for (const auto & slice : m_Stack.slices)
    {
      const std::size_t frame = slice.at(volume);
      const char *      bytes = pixels.data() + frame * m_Pixels.FrameBytes();
      if (m_OneScale)
      {
        sink(bytes, m_Pixels.FrameBytes());
        continue;
      }
      const std::size_t width = PixelBytes(m_Pixels.Type());
      for (std::size_t n = 0; n < scaled.size(); ++n)
      {
        const auto * at = reinterpret_cast<const std::byte *>(bytes + n * width);
        scaled[n] = m_Scales[frame].first * StoredValue(at, m_Pixels.Type()) + m_Scales[frame].second;
      }
      sink(reinterpret_cast<const char *>(scaled.data()), scaled.size() * sizeof(double));
    }
  }

private:
  std::filesystem::path                  m_Path;
  DicomPixels                            m_Pixels;
  PlaneStack                             m_Stack;
  std::vector<std::pair<double, double>> m_Scales; ///< slope and intercept of each frame
  bool                                   m_OneScale = true;
};

} // namespace

std::vector<DicomFrame>
ReadFrames(const std::filesystem::path & path, const gdcm::DataSet & set, const DicomPixels & pixels)
{
  DicomFrame shared;
  shared.slope = pixels.slope;
  shared.intercept = pixels.intercept;
  if (const auto groups = FirstItem(set, gdcm::Tag(0x5200, 0x9229)))
  {
    TakeGroups(*groups, shared);
  }
  const auto each = FieldSequence(set, gdcm::Tag(0x5200, 0x9230));
  if (!each || each->GetNumberOfItems() != static_cast<std::size_t>(pixels.frames))
  {
    RefuseInput(path,
                Text(pixels.frames,
                     pixels.frames == 1 ? " frame" : " frames",
                     " without a place each (Per-frame Functional Groups)"),
                "load it in 3D Slicer and save it as .nrrd");
  }
  std::vector<DicomFrame> frames(static_cast<std::size_t>(pixels.frames), shared);
  for (std::size_t n = 0; n < frames.size(); ++n)
  {
    TakeGroups(each->GetItem(n + 1).GetNestedDataSet(), frames[n]);
  }
  return frames;
}

std::unique_ptr<ScanSource>
OpenFrames(const std::filesystem::path & path, const gdcm::DataSet & set)
{
  return std::make_unique<FramesSource>(path, set);
}

} // namespace voxelcore::itkreader
