#include "DicomPlanes.h"

#include "DicomFields.h"
#include "voxelcore/Base/TextFields.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace voxelcore::itkreader
{
namespace
{

// Positions and directions are decimal numbers that scanners round: what is off by less is at its place.
constexpr double kOffPlace = 0.01;      // of a voxel
constexpr double kSameDirection = 1e-4; // of a unit vector
constexpr double kSameSize = 1e-5;      // of a pixel's side
constexpr double kSamePlace = 1e-4;     // mm

double
LargestPart(const Vector3 & a)
{
  return std::max({ std::abs(a[0]), std::abs(a[1]), std::abs(a[2]) });
}

/** All planes must agree on directions and pixels with the first. */
void
CheckAlike(const std::filesystem::path & path, const std::vector<DicomPlane> & planes)
{
  const DicomPlane & first = planes.front();
  std::size_t        turned = 0;
  for (const DicomPlane & plane : planes)
  {
    if (!plane.position || !plane.alongRow || !plane.alongColumn)
    {
      RefuseInput(path,
                  "slices without a place in space (Image Position and Orientation (Patient))",
                  "such images are no volume: load them in 3D Slicer and save them as .nrrd");
    }
    turned += LargestPart(Minus(*plane.alongRow, *first.alongRow)) > kSameDirection ||
              LargestPart(Minus(*plane.alongColumn, *first.alongColumn)) > kSameDirection;
  }
  if (turned > 0)
  {
    RefuseInput(path,
                Text(turned, " of its ", planes.size(), " slices have another direction than the first"),
                "keep the slices of one volume in one series; localizers are none");
  }
  for (const DicomPlane & plane : planes)
  {
    const auto differs = [](const std::optional<double> & a, const std::optional<double> & b) {
      return a.has_value() != b.has_value() || (a && std::abs(*a - *b) > kSameSize * std::abs(*b));
    };
    if (differs(plane.spacingI, first.spacingI) || differs(plane.spacingJ, first.spacingJ))
    {
      RefuseInput(path, "its slices have pixels of different sizes", "keep the slices of one volume in one series");
    }
  }
}

/** Numbers of the planes, those at one place together, sorted along the normal. */
std::vector<std::vector<std::size_t>>
SortedPlaces(const std::vector<DicomPlane> & planes, const std::vector<double> & heights)
{
  std::vector<std::size_t> order(planes.size());
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return heights[a] < heights[b]; });
  std::vector<std::vector<std::size_t>> places;
  for (const std::size_t plane : order)
  {
    if (places.empty() || heights[plane] - heights[places.back().front()] > kSamePlace)
    {
      places.emplace_back();
    }
    places.back().push_back(plane);
  }
  return places;
}

struct Spacing
{
  double                   distance;
  std::vector<std::size_t> numbers; ///< k of each place
};

/** Equal distances, as measured from the first place to the last. */
Spacing
EqualSpacing(const std::filesystem::path & path,
             const std::vector<double> &   heights,
             std::optional<double>         stated,
             bool                          mayMiss)
{
  double least = heights[1] - heights[0];
  double most = least;
  for (std::size_t k = 1; k < heights.size(); ++k)
  {
    least = std::min(least, heights[k] - heights[k - 1]);
    most = std::max(most, heights[k] - heights[k - 1]);
  }
  const double whole = heights.back() - heights.front();
  double       step = mayMiss ? least : whole / static_cast<double>(heights.size() - 1);
  if (mayMiss && stated && *stated > kSamePlace)
  {
    step = *stated;
  }
  if (mayMiss)
  {
    step = whole / std::max(1.0, std::round(whole / step));
  }
  Spacing spacing{ step, {} };
  for (const double height : heights)
  {
    const double number = (height - heights.front()) / step;
    const double nearest = std::round(number);
    const bool   atItsPlace = mayMiss || nearest == static_cast<double>(spacing.numbers.size());
    if (std::abs(number - nearest) > kOffPlace || !atItsPlace ||
        (!spacing.numbers.empty() && static_cast<std::size_t>(nearest) <= spacing.numbers.back()))
    {
      const double times = most / least;
      const bool   gap = !mayMiss && times > 1.5 && std::abs(times - std::round(times)) < 0.1;
      RefuseInput(path,
                  Text(gap ? "slices are missing: they are " : "its slices are not equally far apart: ",
                       Number(least),
                       " to ",
                       Number(most),
                       " mm",
                       gap ? " apart" : ""),
                  gap ? "add the missing ones" : "resample it to equal distances, in 3D Slicer for example");
    }
    spacing.numbers.push_back(static_cast<std::size_t>(nearest));
  }
  return spacing;
}

} // namespace

void
TakePlaneFields(const gdcm::DataSet & set, DicomPlane & plane)
{
  if (const auto position = FieldVector(set, gdcm::Tag(0x0020, 0x0032)))
  {
    plane.position = position;
  }
  if (const auto orientation = FieldReals(set, gdcm::Tag(0x0020, 0x0037)); orientation && orientation->size() == 6)
  {
    const auto & o = *orientation;
    plane.alongRow = Vector3{ o[0], o[1], o[2] };
    plane.alongColumn = Vector3{ o[3], o[4], o[5] };
  }
  // Distance of rows first, then of columns.
  if (const auto spacing = FieldReals(set, gdcm::Tag(0x0028, 0x0030)); spacing && spacing->size() == 2)
  {
    plane.spacingJ = (*spacing)[0];
    plane.spacingI = (*spacing)[1];
  }
  if (const auto thickness = FieldReal(set, gdcm::Tag(0x0018, 0x0050)))
  {
    plane.thickness = thickness;
  }
  if (const auto distance = FieldReal(set, gdcm::Tag(0x0018, 0x0088)))
  {
    plane.distance = std::abs(*distance);
  }
}

PlaneStack
StackPlanes(const std::filesystem::path & path, const std::vector<DicomPlane> & planes, bool mayMiss, ItkScan & scan)
{
  CheckAlike(path, planes);
  const DicomPlane & first = planes.front();
  const Vector3      normal = Cross(*first.alongRow, *first.alongColumn);
  if (!(Length(normal) > 0.5))
  {
    RefuseInput(path, "its rows and columns run in one direction", "the file is damaged: write it anew");
  }
  std::vector<double> heights;
  for (const DicomPlane & plane : planes)
  {
    heights.push_back(Dot(*plane.position, normal) / Length(normal));
    if (!std::isfinite(heights.back()))
    {
      RefuseInput(path, "a slice has no finite position", "the file is damaged: write it anew");
    }
  }
  const auto          places = SortedPlaces(planes, heights);
  std::vector<double> placeHeights;
  for (const auto & place : places)
  {
    placeHeights.push_back(heights[place.front()]);
  }
  const std::size_t base = places.front().front();
  PlaneStack        stack;
  Vector3           alongStack = normal;
  double            distance = 0;
  if (places.size() == 1)
  {
    const auto thick = first.distance && *first.distance > 0 ? first.distance : first.thickness;
    if (!thick || !(*thick > 0))
    {
      RefuseInput(path, "only one slice, without a thickness", "name the folder of its series");
    }
    distance = *thick;
    scan.notes.push_back(Text("one slice; it is taken to be as thick as it says, ", Number(distance), " mm"));
    stack.slices = { places.front() };
  }
  else
  {
    const Spacing spacing = EqualSpacing(path, placeHeights, first.distance, mayMiss);
    const double  last = static_cast<double>(spacing.numbers.back());
    // Empty frames may be left out, but not without end.
    if (last >= 4096 && last >= 64 * static_cast<double>(places.size()))
    {
      RefuseInput(path, "its slices are too far apart for their distance", "the file is damaged: write it anew");
    }
    const Vector3 way = Minus(*planes[places.back().front()].position, *planes[base].position);
    const Vector3 step{ way[0] / last, way[1] / last, way[2] / last };
    const double  pixel = std::min({ first.spacingI.value_or(1), first.spacingJ.value_or(1), spacing.distance });
    stack.slices.resize(spacing.numbers.back() + 1);
    for (std::size_t n = 0; n < places.size(); ++n)
    {
      const auto    k = spacing.numbers[n];
      const Vector3 place = AddScaled(*planes[base].position, static_cast<double>(k), step);
      for (const std::size_t plane : places[n])
      {
        if (LargestPart(Minus(*planes[plane].position, place)) > kOffPlace * std::max(pixel, 1e-4))
        {
          RefuseInput(path,
                      "its slices do not lie on one straight line",
                      "resample it to one, in 3D Slicer for example");
        }
      }
      stack.slices[k] = places[n];
    }
    distance = Length(step);
    // Off the normal by less than rounding explains it is the normal.
    alongStack = { step[0] / distance, step[1] / distance, step[2] / distance };
    if (LargestPart(Minus(alongStack, normal)) < kSameDirection)
    {
      alongStack = normal;
      distance = spacing.distance;
    }
  }
  scan.axes = { *first.alongRow, *first.alongColumn, alongStack };
  scan.spacing = { first.spacingI.value_or(0), first.spacingJ.value_or(0), distance };
  scan.origin = *planes[base].position;
  scan.size[2] = static_cast<std::int64_t>(stack.slices.size());
  return stack;
}

} // namespace voxelcore::itkreader
