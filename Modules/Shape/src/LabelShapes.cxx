// From the runs of a slab to packed shapes: the second half of LabelCollector.

#include "LabelCollector.h"
#include "voxelcore/TextFields.h"

#include <algorithm>

namespace voxelcore
{
namespace
{

// Beyond these a volume holds grey values, not labels, and its shapes would take memory out of all proportion.
constexpr std::uint64_t kShapeBytesAlways = 1ULL << 30;
constexpr std::uint64_t kShapeBytesPerVoxel = 16;

void
FillRow(std::span<std::uint64_t> words, std::int32_t begin, std::int32_t end)
{
  const auto          first = static_cast<std::size_t>(begin >> 6);
  const auto          last = static_cast<std::size_t>((end - 1) >> 6);
  const std::uint64_t head = ~std::uint64_t{ 0 } << (begin & 63);
  const std::uint64_t tail = ~std::uint64_t{ 0 } >> (63 - ((end - 1) & 63));
  if (first == last)
  {
    words[first] |= head & tail;
    return;
  }
  words[first] |= head;
  std::fill(words.begin() + static_cast<std::ptrdiff_t>(first) + 1,
            words.begin() + static_cast<std::ptrdiff_t>(last),
            ~std::uint64_t{ 0 });
  words[last] |= tail;
}

/** Puts the voxels of `part` into `shape`, whose box contains the part's. */
void
AddShape(const VoxelShape & part, VoxelShape & shape)
{
  const auto shift = static_cast<std::size_t>(part.Box().lower[0] - shape.Box().lower[0]);
  const auto bits = static_cast<int>(shift & 63U);
  for (std::int32_t z = 0; z < part.Box().size[2]; ++z)
  {
    for (std::int32_t y = 0; y < part.Box().size[1]; ++y)
    {
      const auto from = part.Row(y, z);
      const auto to =
        shape.Row(y + part.Box().lower[1] - shape.Box().lower[1], z + part.Box().lower[2] - shape.Box().lower[2]);
      for (std::size_t w = 0; w < from.size(); ++w)
      {
        to[(shift >> 6) + w] |= from[w] << bits;
        if (bits != 0 && (from[w] >> (64 - bits)) != 0)
        {
          to[(shift >> 6) + w + 1] |= from[w] >> (64 - bits);
        }
      }
    }
  }
}

std::uint64_t
BoxBytes(const std::array<std::int32_t, 3> & lower, const std::array<std::int32_t, 3> & upper)
{
  const auto side = [&](std::size_t a) { return static_cast<std::uint64_t>(upper[a] - lower[a] + 1); };
  return (side(0) + 63) / 64 * 8 * side(1) * side(2);
}

VoxelBox
Box(const std::array<std::int32_t, 3> & lower, const std::array<std::int32_t, 3> & upper)
{
  return { lower, { upper[0] - lower[0] + 1, upper[1] - lower[1] + 1, upper[2] - lower[2] + 1 } };
}

} // namespace

void
LabelCollector::FinishSlab()
{
  const auto side = [this](std::size_t a) { return static_cast<std::uint64_t>(m_Part.end[a] - m_Part.first[a]); };
  const std::uint64_t voxels = side(0) * side(1) * side(2);
  const std::uint64_t limit = std::max(kShapeBytesAlways, kShapeBytesPerVoxel * voxels);
  for (const std::int32_t index : m_Touched)
  {
    Target &                    target = m_Targets[static_cast<std::size_t>(index)];
    std::array<std::int32_t, 3> lower{ INT32_MAX, INT32_MAX, INT32_MAX };
    std::array<std::int32_t, 3> upper{ -1, -1, -1 };
    for (const Run & run : target.runs)
    {
      lower = { std::min(lower[0], run.x), std::min(lower[1], run.y), std::min(lower[2], run.z) };
      upper = { std::max(upper[0], run.end - 1), std::max(upper[1], run.y), std::max(upper[2], run.z) };
    }
    for (std::size_t a = 0; a < 3; ++a)
    {
      target.lower[a] = std::min(target.lower[a], lower[a]);
      target.upper[a] = std::max(target.upper[a], upper[a]);
    }
    m_Bytes -= target.bytes;
    target.bytes = BoxBytes(target.lower, target.upper);
    m_Bytes += target.bytes;
    if (m_Bytes > limit)
    {
      RefuseInput(m_Scan.path,
                  Text(m_Targets.size(),
                       " labels scattered over the scan would take more than ",
                       limit >> 30,
                       " GB as shapes: these look like grey values"),
                  "give --threshold LO:HI, or choose some with --labels");
    }
    Piece piece;
    if (target.runs.size() * sizeof(Run) < BoxBytes(lower, upper))
    {
      piece.runs = std::vector<Run>(target.runs.begin(), target.runs.end()); // without spare capacity
    }
    else
    {
      piece.bits = VoxelShape(Box(lower, upper));
      for (const Run & run : target.runs)
      {
        FillRow(piece.bits.Row(run.y - lower[1], run.z - lower[2]), run.x - lower[0], run.end - lower[0]);
      }
    }
    target.pieces.push_back(std::move(piece));
    target.runs.clear();
    target.touched = false;
  }
  m_Touched.clear();
}

std::vector<LabelShape>
LabelCollector::TakeShapes()
{
  std::vector<LabelNaming::Label> present;
  // Layers outside the part are looked at too, so values may have been found that have no voxel in it.
  for (const Found & found : m_Found)
  {
    if (found.isIn)
    {
      present.push_back(found.label);
    }
  }
  std::erase_if(m_Targets, [](const Target & target) { return target.pieces.empty(); });
  const std::string where = m_IsPart ? " within the crop" : "";
  if (m_Threshold && m_Targets.empty())
  {
    RefuseInput(m_Scan.path, "no voxel" + where + " lies within the threshold", "choose other bounds");
  }
  if (present.empty() && !m_Threshold)
  {
    RefuseInput(m_Scan.path,
                "nothing but background: every voxel" + where + " is 0",
                m_IsPart ? "choose another part" : "name a scan with labels");
  }
  std::sort(present.begin(), present.end(), [](const auto & a, const auto & b) { return a.value < b.value; });
  m_Naming.RefuseMissing(m_Scan.path, present, where);

  std::sort(m_Targets.begin(), m_Targets.end(), [](const Target & a, const Target & b) {
    return a.label.value < b.label.value;
  });
  std::vector<LabelShape> shapes;
  for (Target & target : m_Targets)
  {
    std::vector<Run>().swap(target.runs);
    LabelShape label;
    label.value = target.label.value;
    label.name = target.label.name;
    label.color = target.label.color;
    label.shape = VoxelShape(Box(target.lower, target.upper));
    for (Piece & piece : target.pieces)
    {
      for (const Run & run : piece.runs)
      {
        FillRow(label.shape.Row(run.y - target.lower[1], run.z - target.lower[2]),
                run.x - target.lower[0],
                run.end - target.lower[0]);
      }
      if (piece.runs.empty())
      {
        AddShape(piece.bits, label.shape);
      }
      piece = Piece(); // its memory goes while the shape's comes
    }
    label.voxels = label.shape.CountVoxels();
    shapes.push_back(std::move(label));
    target = Target();
  }
  return shapes;
}

} // namespace voxelcore
