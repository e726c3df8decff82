#include "voxelcore/Labels/LabelAssembler.h"

#include "GreyTest.h"
#include "LabelCollector.h"

#include <algorithm>
#include <exception>
#include <optional>
#include <utility>

namespace voxelcore
{
namespace
{

constexpr std::size_t kBlockBytes = 4U << 20;
constexpr std::size_t kSlabBytes = 1U << 20; // of rows before what they hold is packed

PixelType
StoredType(LabelAssembler::Pixel pixel)
{
  if (pixel.isReal)
  {
    return pixel.bytes == 4 ? PixelType::Float32 : PixelType::Float64;
  }
  switch (pixel.bytes)
  {
    case 1:
      return pixel.isSigned ? PixelType::Int8 : PixelType::UInt8;
    case 2:
      return pixel.isSigned ? PixelType::Int16 : PixelType::UInt16;
    case 4:
      return pixel.isSigned ? PixelType::Int32 : PixelType::UInt32;
    default:
      return pixel.isSigned ? PixelType::Int64 : PixelType::UInt64;
  }
}

StoredVoxels
InMemory(const std::string & name, const ImageGeometry & geometry, LabelAssembler::Pixel pixel)
{
  StoredVoxels voxels;
  voxels.path = name;
  voxels.type = StoredType(pixel);
  voxels.geometry = geometry;
  return voxels;
}

} // namespace

struct LabelAssembler::State
{
  State(StoredVoxels voxels, const LabelChoice & choice)
    : scan(std::move(voxels))
    , part(ResolveCrop(choice.crop, scan.geometry.size, scan.path))
    , rowBytes(static_cast<std::size_t>(scan.geometry.size[0]) * scan.interleaved * PixelBytes(scan.type))
    , collector(std::in_place, scan, choice, part)
    , needsAllRows(collector->NeedsAllRows())
  {
    if (choice.refuseGrey && choice.labels == "all" && !choice.binary && !choice.threshold && !scan.HasLayers() &&
        scan.segments.empty())
    {
      greyTest.emplace(scan, part);
    }
  }

  /** Has the collector work as long as there is one. Where the scan may yet turn out grey, what it throws is kept. */
  template <typename Work>
  void
  Collect(const Work & work)
  {
    if (!collector)
    {
      return;
    }
    try
    {
      work(*collector);
    }
    catch (const InputError &)
    {
      if (!greyTest)
      {
        throw;
      }
      noLabel = std::current_exception();
      collector.reset();
    }
  }

  void
  FinishSlab()
  {
    pending = 0;
    if (greyTest && !isGrey && greyTest->IsTimeToLook() && greyTest->LooksGrey())
    {
      isGrey = true;
      collector.reset();
    }
    Collect([](LabelCollector & labels) { labels.FinishSlab(); });
  }

  const StoredVoxels            scan;
  const CropRange               part;
  const std::size_t             rowBytes;
  std::optional<LabelCollector> collector; ///< none once the scan is known to be grey or to hold what is no label
  const bool                    needsAllRows;
  std::optional<GreyTest>       greyTest;
  bool                          isGrey = false;
  std::exception_ptr            noLabel;
  std::size_t                   pending = 0; ///< bytes of rows since the last slab was finished
};

LabelAssembler::LabelAssembler(StoredVoxels scan, const LabelChoice & choice)
  : m_State(std::make_unique<State>(std::move(scan), choice))
{}

LabelAssembler::LabelAssembler(const std::string &   name,
                               const ImageGeometry & geometry,
                               Pixel                 pixel,
                               const LabelChoice &   choice)
  : LabelAssembler(InMemory(name, geometry, pixel), choice)
{}

LabelAssembler::~LabelAssembler() = default;

const CropRange &
LabelAssembler::Part() const
{
  return m_State->part;
}

bool
LabelAssembler::NeedsAllRows() const
{
  return m_State->needsAllRows;
}

std::size_t
LabelAssembler::RowsAtATime() const
{
  return std::max<std::size_t>(1, kBlockBytes / m_State->rowBytes);
}

void
LabelAssembler::AddRows(const void * rows, std::uint64_t firstRow, std::size_t rowCount)
{
  State & state = *m_State;
  for (std::size_t row = 0; row < rowCount;)
  {
    const std::size_t count = std::min(RowsAtATime(), rowCount - row);
    const auto *      bytes = static_cast<const std::byte *>(rows) + row * state.rowBytes;
    if (state.greyTest)
    {
      state.greyTest->AddRows(bytes, firstRow + row, count);
    }
    state.Collect([&](LabelCollector & labels) { labels.AddRows(bytes, firstRow + row, count); });
    row += count;
    state.pending += count * state.rowBytes;
    if (state.pending >= kSlabBytes)
    {
      state.FinishSlab();
    }
  }
}

bool
LabelAssembler::IsRenumbered() const
{
  return m_State->collector && m_State->collector->Naming().IsRenumbered();
}

std::vector<double>
LabelAssembler::PassedOver() const
{
  return m_State->collector ? m_State->collector->PassedOver() : std::vector<double>();
}

std::vector<LabelShape>
LabelAssembler::TakeShapes()
{
  State & state = *m_State;
  state.FinishSlab();
  if (state.greyTest && (state.isGrey || state.greyTest->LooksGrey()))
  {
    RefuseGrey(state.scan, *state.greyTest);
  }
  if (state.noLabel)
  {
    std::rethrow_exception(state.noLabel);
  }
  return state.collector->TakeShapes();
}

} // namespace voxelcore
