#include "BandField.h"
#include "Vectors.h"

#include "voxelcore/SurfaceEstimate.h"

#include <algorithm>

namespace voxelcore
{

namespace
{

// Where a field is 0; where it has no good answer the next one is asked. The first `thick` of the fields are for thick
// parts only; what is thick the last field says.
class FieldSurface : public SurfaceEstimate
{
public:
  FieldSurface(std::vector<BandField> fields, std::size_t thick, const Vector3 & spacing)
    : m_Fields(std::move(fields))
    , m_Thick(thick)
    , m_Spacing(spacing)
  {}

  SurfacePoint
  Project(const Vector3 & place, double reach) const override
  {
    for (std::size_t i = m_Thick > 0 && IsThick(place) ? 0 : m_Thick; i < m_Fields.size(); ++i)
    {
      const SurfacePoint point = Project(m_Fields[i], place, reach);
      if (point.found)
      {
        return point;
      }
    }
    return {};
  }

private:
  // Whether the distance still grows six voxels behind the surface, as far as distances are followed.
  bool
  IsThick(const Vector3 & place) const
  {
    constexpr double  depth = 6;
    constexpr double  most = 0.85; // of Far(): smoothing takes the top off a ridge
    const BandField & field = m_Fields.back();
    const Vector3     at = Over(place, m_Spacing);
    double            value = 0;
    Vector3           slope{};
    if (!field.Evaluate(at, value, slope) || Length(slope) == 0)
    {
      return false;
    }
    return field.Evaluate(Along(at, depth / Length(slope), slope), value, slope) && value >= most * field.Far();
  }

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
  std::size_t            m_Thick;
  Vector3                m_Spacing;
};

} // namespace

std::unique_ptr<SurfaceEstimate>
SurfaceFromLabels(const VoxelShape & shape, const Vector3 & spacing, const ProgressCallback & progress)
{
  // Many passes are best where parts are thick, but from the ridge in the middle of a part they carry an error to its
  // surface if that is near; the thinnest parts do not survive even a few.
  constexpr int          manyPasses = 20;
  constexpr int          fewPasses = 3;
  constexpr double       clip = 6;
  std::vector<BandField> fields;
  BandField              field(shape);
  field.FillDistances(clip);
  field.Smooth();
  fields.push_back(field);
  for (int pass = 1; pass < manyPasses; ++pass)
  {
    ReportProgress(progress, "surface", static_cast<double>(pass) / manyPasses);
    field.ClearContradictions();
    field.Smooth();
    if (pass + 1 == fewPasses)
    {
      fields.insert(fields.begin(), field);
    }
  }
  fields.insert(fields.begin(), std::move(field));
  return std::make_unique<FieldSurface>(std::move(fields), 1, spacing);
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
  fields[0].Smooth(BandField::kStepWeight);
  return std::make_unique<FieldSurface>(std::move(fields), 0, spacing);
}

} // namespace voxelcore
