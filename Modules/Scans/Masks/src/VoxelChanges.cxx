#include "voxelcore/Masks/VoxelChanges.h"

#include "voxelcore/Shape/ShapeBits.h"
#include "voxelcore/Shape/ShapeRuns.h"

#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/TextFields.h"
#include "voxelcore/Shape/ShapeOperations.h"

#include <algorithm>
#include <bit>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

namespace voxelcore
{

namespace
{

constexpr std::int64_t kMostIndex = std::int64_t{ 1 } << 30;

/** A whole number of voxels at the start of `word`, which is taken off. */
std::optional<std::int32_t>
TakeNumber(std::string_view & word)
{
  const std::size_t digits = std::min(word.find_first_not_of("0123456789"), word.size());
  const auto        value = ParseInteger(word.substr(0, digits));
  if (digits == 0 || !value || *value > kMostIndex)
  {
    return std::nullopt;
  }
  word.remove_prefix(digits);
  return static_cast<std::int32_t>(*value);
}

std::optional<VoxelRun>
ParseRun(std::string_view word)
{
  if (word.empty() || (word.front() != '+' && word.front() != '-'))
  {
    return std::nullopt;
  }
  VoxelRun run;
  run.isAdded = word.front() == '+';
  word.remove_prefix(1);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const auto number = TakeNumber(word);
    if (!number || (axis < 2 && (word.empty() || word.front() != ',')))
    {
      return std::nullopt;
    }
    run.first[axis] = *number;
    word.remove_prefix(axis < 2 ? 1 : 0);
  }
  if (!word.empty())
  {
    if (word.front() != 'x')
    {
      return std::nullopt;
    }
    word.remove_prefix(1);
    const auto number = TakeNumber(word);
    if (!number || *number == 0 || !word.empty())
    {
      return std::nullopt;
    }
    run.length = *number;
  }
  return run;
}

} // namespace

VoxelChanges
ParseVoxelChanges(const std::string & text)
{
  VoxelChanges changes;
  for (std::size_t from = 0; from <= text.size();)
  {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    std::string_view  line = std::string_view(text).substr(from, end - from);
    line = Trim(line.substr(0, line.find('#')));
    for (const std::string_view word : Words(line))
    {
      const auto run = ParseRun(word);
      if (!run)
      {
        throw UsageError(Text(Printable(word), " is no run of voxels; write +I,J,K or -I,J,K, with xN for N along I"));
      }
      changes.push_back(*run);
    }
    from = end + 1;
  }
  return changes;
}

VoxelChanges
ReadVoxelChanges(const std::filesystem::path & path)
{
  std::ifstream      file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file)
  {
    throw InputError(path.string() + ": cannot be read; give a text file with runs of voxels");
  }
  try
  {
    return ParseVoxelChanges(text.str());
  }
  catch (const UsageError & error)
  {
    throw InputError(path.string() + ": " + error.what());
  }
}

std::string
VoxelChangesText(const VoxelChanges & changes)
{
  std::string text;
  for (const VoxelRun & run : changes)
  {
    text += text.empty() ? "" : " ";
    text += run.isAdded ? '+' : '-';
    text += Text(run.first[0], ",", run.first[1], ",", run.first[2]);
    text += run.length > 1 ? Text("x", run.length) : std::string();
  }
  return text;
}

VoxelChanges
ChangesBetween(const VoxelShape & before, const VoxelShape & after)
{
  VoxelChanges changes;
  VoxelShape   from(BoxOfBoth(before.Box(), after.Box()));
  VoxelShape   to(from.Box());
  PutInto(before, from);
  PutInto(after, to);
  const VoxelBox & box = from.Box();
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      const auto a = std::as_const(from).Row(y, z);
      const auto b = std::as_const(to).Row(y, z);
      for (std::size_t word = 0; word < a.size(); ++word)
      {
        for (std::uint64_t bits = a[word] ^ b[word]; bits != 0; bits &= bits - 1)
        {
          const int        bit = std::countr_zero(bits);
          const bool       isAdded = (b[word] >> bit & 1U) != 0;
          const auto       x = static_cast<std::int32_t>(64 * word) + bit;
          const VoxelRun   one{ isAdded, { x + box.lower[0], y + box.lower[1], z + box.lower[2] }, 1 };
          VoxelRun * const last = changes.empty() ? nullptr : &changes.back();
          if (last != nullptr && last->isAdded == isAdded && last->first[1] == one.first[1] &&
              last->first[2] == one.first[2] && last->first[0] + last->length == one.first[0])
          {
            ++last->length;
          }
          else
          {
            changes.push_back(one);
          }
        }
      }
    }
  }
  return changes;
}

ChangedShape
ChangeVoxels(const VoxelShape & shape, const VoxelChanges & changes)
{
  VoxelBox box = shape.Box();
  for (const VoxelRun & run : changes)
  {
    if (run.isAdded)
    {
      box = BoxOfBoth(box, { run.first, { run.length, 1, 1 } });
    }
  }
  ChangedShape result{ VoxelShape(box) };
  PutInto(shape, result.shape);
  for (const VoxelRun & run : changes)
  {
    const std::int32_t y = run.first[1] - box.lower[1];
    const std::int32_t z = run.first[2] - box.lower[2];
    const std::int32_t begin = std::max(run.first[0] - box.lower[0], 0);
    const std::int32_t end = std::min(run.first[0] - box.lower[0] + run.length, box.size[0]);
    if (y < 0 || z < 0 || y >= box.size[1] || z >= box.size[2] || begin >= end)
    {
      continue; // background is taken out
    }
    SetRun(result.shape.Row(y, z), begin, end, run.isAdded);
  }
  for (const VoxelRun & run : ChangesBetween(shape, result.shape))
  {
    (run.isAdded ? result.voxelsAdded : result.voxelsRemoved) += static_cast<std::uint64_t>(run.length);
  }
  result.shape = Tightened(std::move(result.shape));
  return result;
}

} // namespace voxelcore
