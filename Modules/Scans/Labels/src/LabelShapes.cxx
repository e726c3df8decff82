// From the runs of a slab to packed shapes: the second half of LabelCollector.

#include "LabelCollector.h"
#include "voxelcore/Base/Text.h"
#include "voxelcore/Base/TextFields.h"

#include <algorithm>
#include <span>

namespace voxelcore
{
namespace
{

// Beyond these a volume holds grey values, not labels, and its shapes would take memory out of all proportion.
constexpr std::uint64_t kShapeBytesAlways = 1ULL << 30;
constexpr std::uint64_t kShapeBytesPerVoxel = 16;

/** Puts the voxels begin to end - 1 of a row in, of a shape or of packed words. */
template <typename TRow>
void
FillRow(const TRow & words, std::int32_t begin, std::int32_t end)
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
  for (std::size_t word = first + 1; word < last; ++word)
  {
    words[word] = ~std::uint64_t{ 0 };
  }
  words[last] |= tail;
}

std::size_t
WordsPerRow(const VoxelBox & box)
{
  return (static_cast<std::size_t>(box.size[0]) + 63) / 64;
}

/** Row y, z of the packed words of a box. */
std::span<std::uint64_t>
RowOf(std::vector<std::uint64_t> & bits, const VoxelBox & box, std::int32_t y, std::int32_t z)
{
  const auto row = static_cast<std::size_t>(z) * static_cast<std::size_t>(box.size[1]) + static_cast<std::size_t>(y);
  return std::span(bits).subspan(row * WordsPerRow(box), WordsPerRow(box));
}

/** Puts the voxels of a box' packed words into `shape`, whose box contains it. */
void
AddBits(std::vector<std::uint64_t> & bits, const VoxelBox & box, VoxelShape & shape)
{
  const auto shift = static_cast<std::size_t>(box.lower[0] - shape.Box().lower[0]);
  const auto by = static_cast<int>(shift & 63U);
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      const auto from = RowOf(bits, box, y, z);
      const auto to = shape.Row(y + box.lower[1] - shape.Box().lower[1], z + box.lower[2] - shape.Box().lower[2]);
      for (std::size_t w = 0; w < from.size(); ++w)
      {
        to[(shift >> 6) + w] |= from[w] << by;
        if (by != 0 && (from[w] >> (64 - by)) != 0)
        {
          to[(shift >> 6) + w + 1] |= from[w] >> (64 - by);
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
    piece.box = Box(lower, upper);
    if (target.runs.size() * sizeof(Run) < BoxBytes(lower, upper))
    {
      piece.runs = std::vector<Run>(target.runs.begin(), target.runs.end()); // without spare capacity
    }
    else
    {
      piece.bits.resize(BoxBytes(lower, upper) / sizeof(std::uint64_t));
      for (const Run & run : target.runs)
      {
        FillRow(RowOf(piece.bits, piece.box, run.y - lower[1], run.z - lower[2]), run.x - lower[0], run.end - lower[0]);
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
  if (m_Threshold && m_Targets.empty() && !m_MayBeMissing)
  {
    const std::string bounds = ShortText(m_Threshold->first) + ":" + ShortText(m_Threshold->second);
    RefuseInput(m_Scan.path,
                "no voxel" + where + " lies within the threshold " + bounds,
                "give other bounds, or the scan that these are of");
  }
  if (present.empty() && !m_Threshold && !m_MayBeMissing)
  {
    RefuseInput(m_Scan.path,
                "nothing but background: every voxel" + where + " is 0",
                m_IsPart ? "choose another part" : "name a scan with labels");
  }
  std::sort(present.begin(), present.end(), [](const auto & a, const auto & b) { return a.value < b.value; });
  if (!m_MayBeMissing)
  {
    m_Naming.RefuseMissing(m_Scan.path, present, where);
  }

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
    std::int32_t compact = 0; // as far as this shape takes no more memory than it must
    for (Piece & piece : target.pieces)
    {
      // Pieces come in the order of their slices.
      if (const std::int32_t done = (piece.box.lower[2] - target.lower[2]) & ~7; done > compact)
      {
        label.shape.Compact(compact, done);
        compact = done;
      }
      for (const Run & run : piece.runs)
      {
        FillRow(label.shape.Row(run.y - target.lower[1], run.z - target.lower[2]),
                run.x - target.lower[0],
                run.end - target.lower[0]);
      }
      if (piece.runs.empty())
      {
        AddBits(piece.bits, piece.box, label.shape);
      }
      piece = Piece(); // its memory goes while the shape's comes
    }
    label.shape.Compact(compact, label.shape.Box().size[2]);
    label.voxels = label.shape.CountVoxels();
    shapes.push_back(std::move(label));
    target = Target();
  }
  return shapes;
}

} // namespace voxelcore
