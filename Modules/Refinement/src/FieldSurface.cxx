#include "BandField.h"
#include "Vectors.h"

#include "voxelcore/SurfaceEstimate.h"

#include <algorithm>

namespace voxelcore
{

namespace
{

// Where a field is 0; where it has no good answer the next one is asked.
class FieldSurface : public SurfaceEstimate
{
public:
  FieldSurface(std::vector<BandField> fields, const Vector3 & spacing)
    : m_Fields(std::move(fields))
    , m_Spacing(spacing)
  {}

  SurfacePoint
  Project(const Vector3 & place, double reach) const override
  {
    for (const BandField & field : m_Fields)
    {
      const SurfacePoint point = Project(field, place, reach);
      if (point.found)
      {
        return point;
      }
    }
    return {};
  }

private:
  SurfacePoint
  Project(const BandField & field, const Vector3 & place, double reach) const
  {
    constexpr int    steps = 6;
    constexpr double longest = 1.0;   // voxels a step
    constexpr double close = 1e-4;    // voxels
    constexpr double flattest = 0.08; // of Far() a voxel: where labels allow no surface, the field is flat
    Vector3          at = Over(place, m_Spacing);
    SurfacePoint     point;
    for (int step = 0; step <= steps; ++step)
    {
      double  value = 0;
      Vector3 slope{};
      if (!field.Evaluate(at, value, slope) || Length(slope) < flattest * field.Far())
      {
        return point;
      }
      const Vector3 normal = Over(slope, m_Spacing); // per mm
      const double  squared = Dot(normal, normal);
      Vector3       move = Over(Along({ 0, 0, 0 }, -value / squared, normal), m_Spacing);
      const double  length = Length(move);
      if (length < close || step == steps)
      {
        point.position = Times(at, m_Spacing);
        point.normal = Along({ 0, 0, 0 }, -1 / std::sqrt(squared), normal);
        point.found = length < 10 * close && Distance(point.position, place) <= reach;
        return point;
      }
      at = Along(at, std::min(1.0, longest / length), move);
    }
    return point;
  }

  std::vector<BandField> m_Fields;
  Vector3                m_Spacing;
};

} // namespace

std::unique_ptr<SurfaceEstimate>
SurfaceFromLabels(const VoxelShape & shape, const Vector3 & spacing, const ProgressCallback & progress)
{
  constexpr int          passes = 20;
  constexpr double       clip = 6;
  std::vector<BandField> fields;
  fields.emplace_back(shape);
  fields[0].FillDistances(clip);
  fields[0].Smooth();
  // Parts of less than three voxels do not survive the rest: there the first pass must do.
  fields.push_back(fields[0]);
  for (int pass = 1; pass < passes; ++pass)
  {
    ReportProgress(progress, "surface", static_cast<double>(pass) / passes);
    fields[0].ClearContradictions();
    fields[0].Smooth();
  }
  return std::make_unique<FieldSurface>(std::move(fields), spacing);
}

std::unique_ptr<SurfaceEstimate>
SurfaceFromGrey(const VoxelShape &       shape,
                const Vector3 &          spacing,
                const VoxelBox &         scan,
                const GreyRows &         rows,
                const ProgressCallback & progress)
{
  std::vector<BandField> fields;
  fields.emplace_back(shape);
  fields[0].FillGrey(scan, rows);
  ReportProgress(progress, "surface", 0.5);
  fields[0].Smooth();
  return std::make_unique<FieldSurface>(std::move(fields), spacing);
}

} // namespace voxelcore
