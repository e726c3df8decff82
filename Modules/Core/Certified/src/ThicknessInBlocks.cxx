#include "voxelcore/Certified/ThicknessInBlocks.h"

#include "CertificateText.h"
#include "CheckedLattice.h"
#include "Frames.h"
#include "InscribedThickness.h"
#include "RequestStages.h"
#include "voxelcore/Base/StagePlan.h"
#include "voxelcore/Shape/ShapeOperations.h"
#include "voxelcore/Thickness/SmoothBalls.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace voxelcore
{

namespace
{

using Margin = std::array<std::int32_t, 3>;

/** Whether all that lies within the margin of a block, in the box of the shape, lies in the window. */
bool
Holds(const VoxelBox & window, const VoxelBox & block, const Margin & margin, const VoxelBox & all)
{
  const VoxelBox needed = WindowOf(block, margin, all);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (needed.lower[axis] < window.lower[axis] ||
        needed.lower[axis] + needed.size[axis] > window.lower[axis] + window.size[axis])
    {
      return false;
    }
  }
  return true;
}

/** Voxels of a row, in indices of the scan, before x. */
std::size_t
CountBefore(const VoxelShape & shape, std::int32_t x, std::int32_t y, std::int32_t z)
{
  const VoxelBox & box = shape.Box();
  const auto       row = shape.Row(y - box.lower[1], z - box.lower[2]);
  return static_cast<std::size_t>(CountBits(row, 0, std::clamp(x - box.lower[0], 0, box.size[0])));
}

template <typename T>
std::size_t
RowStart(const VoxelField<T> & field, std::int32_t y, std::int32_t z)
{
  const auto row = static_cast<std::size_t>(z - field.box.lower[2]) * static_cast<std::size_t>(field.box.size[1]) +
                   static_cast<std::size_t>(y - field.box.lower[1]);
  return field.rowStarts[row];
}

class Work
{
public:
  Work(const VoxelShape &       shape,
       const ImageGeometry &    geometry,
       const CertifiedRequest & request,
       const BallTest &         isAtBorder)
    : m_Shape(shape)
    , m_Geometry(geometry)
    , m_Request(request)
    , m_IsAtBorder(isAtBorder)
    , m_Refines(Refines(request))
  {
    m_Request.thickness = ThicknessRequest{ .bounds = false, .alone = true };
    m_Result.map = ZeroAtVoxels<float>(shape);
    m_Result.atBorder.assign(m_Result.map.values.size(), 0);
  }

  void
  Compute(const VoxelBox & block, const ProgressCallback & progress)
  {
    VoxelShape part = VoxelsWithin(m_Shape, block);
    if (part.Box().size[0] == 0)
    {
      return;
    }
    constexpr Margin near{ 16, 16, 16 };
    double           reach = GuessReach(VoxelsWithin(m_Shape, WindowOf(block, near, m_Shape.Box())), m_Geometry);
    while (true)
    {
      const VoxelBox     window = WindowOf(block, MarginOfBlocks(m_Request, m_Geometry, reach), m_Shape.Box());
      CertifiedThickness found = Find(VoxelsWithin(m_Shape, window), part, progress);
      ++m_Result.computed;
      reach = ReachOf(found);
      if (Holds(window, block, MarginOfBlocks(m_Request, m_Geometry, reach), m_Shape.Box()))
      {
        Take(found, block);
        return;
      }
    }
  }

  BlockedThickness
  Finish()
  {
    const auto & values = m_Result.map.values;
    if (std::any_of(values.begin(), values.end(), [](float value) { return !(value > 0); }))
    {
      RefuseResult(m_Request.name, "a voxel has no thickness");
    }
    return std::move(m_Result);
  }

private:
  CertifiedThickness
  Find(VoxelShape window, const VoxelShape & part, const ProgressCallback & progress) const
  {
    if (!m_Refines)
    {
      return InscribedThickness(window, &part, m_Geometry, m_Request, progress);
    }
    const SurfaceSource::Estimate surface = SurfaceForThickness(m_Request, window, progress);
    return SmoothThickness(std::move(window),
                           ComputeLatticeWeights(m_Geometry),
                           surface.get(),
                           false,
                           m_Request.name,
                           progress);
  }

  double
  ReachOf(const CertifiedThickness & found) const
  {
    const auto & radii = found.balls.radius;
    return !m_Refines ? found.bracket.reach : radii.empty() ? 0.0 : *std::max_element(radii.begin(), radii.end());
  }

  /** Takes over what was found at the block's voxels; what was found may lie around it. */
  void
  Take(const CertifiedThickness & found, const VoxelBox & block)
  {
    const std::vector<char> touches = m_IsAtBorder(found.balls);
    for (const double radius : found.balls.radius)
    {
      m_Result.reach = std::max(m_Result.reach, radius);
    }
    const VoxelBox & box = found.shape.Box();
    const auto       first = [&](std::size_t axis) { return std::max(block.lower[axis], box.lower[axis]); };
    const auto       end = [&](std::size_t axis) {
      return std::min(block.lower[axis] + block.size[axis], box.lower[axis] + box.size[axis]);
    };
    for (std::int32_t z = first(2); z < end(2); ++z)
    {
      for (std::int32_t y = first(1); y < end(1); ++y)
      {
        std::size_t       from = RowStart(found.map, y, z) + CountBefore(found.shape, first(0), y, z);
        const std::size_t last = RowStart(found.map, y, z) + CountBefore(found.shape, end(0), y, z);
        std::size_t       to = RowStart(m_Result.map, y, z) + CountBefore(m_Shape, first(0), y, z);
        for (; from < last; ++from, ++to)
        {
          m_Result.map.values[to] = found.map.values[from];
          const std::uint32_t owner = found.owners.values[from];
          m_Result.atBorder[to] = owner == 0 ? char{ 0 } : touches[owner - 1];
        }
      }
    }
  }

  const VoxelShape &    m_Shape;
  const ImageGeometry & m_Geometry;
  CertifiedRequest      m_Request;
  const BallTest &      m_IsAtBorder;
  bool                  m_Refines;
  BlockedThickness      m_Result;
};

} // namespace

std::array<std::int32_t, 3>
MarginOfBlocks(const CertifiedRequest & request, const ImageGeometry & geometry, double reach)
{
  const SpacingWeights weights = ComputeLatticeWeights(geometry);
  double               longest = 0;
  for (const std::int64_t weight : weights.weight)
  {
    longest = std::max(longest, static_cast<double>(weight) * weights.unit);
  }
  const double needed = 4 * reach + (Refines(request) ? kSmoothReach * longest : 0);
  Margin       margin{};
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double side = static_cast<double>(weights.weight[axis]) * weights.unit;
    margin[axis] = static_cast<std::int32_t>(std::ceil(std::min((needed + longest) / side, 1e9))) + 1;
  }
  return margin;
}

double
GuessReach(const VoxelShape & shape, const ImageGeometry & geometry)
{
  const auto &               size = shape.Box().size;
  const auto                 rows = static_cast<std::size_t>(size[1]);
  const auto                 layers = static_cast<std::size_t>(size[2]);
  const std::size_t          words = shape.WordsPerRow();
  std::vector<std::uint64_t> bits(words * rows * layers);
  for (std::size_t z = 0; z < layers; ++z)
  {
    for (std::size_t y = 0; y < rows; ++y)
    {
      const auto row = shape.Row(static_cast<std::int32_t>(y), static_cast<std::int32_t>(z));
      std::copy(row.begin(), row.end(), bits.begin() + static_cast<std::ptrdiff_t>((z * rows + y) * words));
    }
  }
  const auto at = [&](std::size_t word, std::size_t y, std::size_t z) {
    return y < rows && z < layers ? bits[(z * rows + y) * words + word] : 0; // before 0 comes the greatest number
  };
  int                        rounds = 0;
  std::vector<std::uint64_t> left(bits.size());
  for (bool any = true; any; ++rounds)
  {
    any = false;
    for (std::size_t z = 0; z < layers; ++z)
    {
      for (std::size_t y = 0; y < rows; ++y)
      {
        for (std::size_t word = 0; word < words; ++word)
        {
          const std::uint64_t here = at(word, y, z);
          const std::uint64_t before = here << 1U | (word > 0 ? at(word - 1, y, z) >> 63U : 0);
          const std::uint64_t after = here >> 1U | (word + 1 < words ? at(word + 1, y, z) << 63U : 0);
          const std::uint64_t stays =
            here & before & after & at(word, y - 1, z) & at(word, y + 1, z) & at(word, y, z - 1) & at(word, y, z + 1);
          left[(z * rows + y) * words + word] = stays;
          any = any || stays != 0;
        }
      }
    }
    bits.swap(left);
  }
  const Vector3 & spacing = geometry.spacing;
  return (rounds + 1) * std::cbrt(spacing[0] * spacing[1] * spacing[2]);
}

VoxelBox
WindowOf(const VoxelBox & block, const std::array<std::int32_t, 3> & margin, const VoxelBox & shape)
{
  VoxelBox window;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const std::int32_t lower = std::max(block.lower[axis] - margin[axis], shape.lower[axis]);
    const std::int32_t upper =
      std::min(block.lower[axis] + block.size[axis] + margin[axis], shape.lower[axis] + shape.size[axis]);
    window.lower[axis] = lower;
    window.size[axis] = upper - lower;
  }
  return window;
}

BlockedThickness
ThicknessInBlocks(const VoxelShape &        shape,
                  const ImageGeometry &     geometry,
                  const CertifiedRequest &  request,
                  std::span<const VoxelBox> blocks,
                  const BallTest &          isAtBorder,
                  const ProgressCallback &  progress)
{
  const BodyFrame  frame(geometry, CropToVoxels(shape).Box());
  const VoxelShape moved = MovedTo(frame.Enter(shape.Box()).lower, shape);
  const BallTest   isAtBorderThere = [&](PaintingBalls balls) {
    LeaveFrame(frame, balls);
    return isAtBorder(balls);
  };
  const SpacingWeights weights = ComputeLatticeWeights(geometry);
  RequireTrueLattice(weights, frame.Geometry(), moved.Box(), request.name);
  const CertifiedRequest complete = InFrame(CompleteRequest(request, geometry.spacing), frame, weights);
  Work                   work(moved, frame.Geometry(), complete, isAtBorderThere);
  for (std::size_t i = 0; i < blocks.size(); ++i)
  {
    const auto share = [&](std::size_t done) { return static_cast<double>(done) / static_cast<double>(blocks.size()); };
    const std::string name = "block " + std::to_string(i + 1) + " of " + std::to_string(blocks.size());
    work.Compute(frame.Enter(blocks[i]), NamedPartOfProgress(progress, name, share(i), share(i + 1)));
  }
  BlockedThickness found = work.Finish();
  found.map.box = frame.Leave(found.map.box);
  return found;
}

} // namespace voxelcore
