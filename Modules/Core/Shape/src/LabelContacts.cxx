#include "voxelcore/Shape/LabelContacts.h"

#include "voxelcore/Base/UnionFind.h"
#include "voxelcore/Shape/ShapeBits.h"
#include "voxelcore/Shape/ShapeOperations.h"

#include <algorithm>
#include <bit>
#include <tuple>
#include <utility>

namespace voxelcore
{

namespace
{

using Voxel = std::array<std::int32_t, 3>;

/** A voxel of one of two labels that touch. */
struct ContactVoxel
{
  std::array<std::uint32_t, 2> pair;
  Voxel                        voxel;

  auto
  Key() const
  {
    return std::tuple(pair, voxel[2], voxel[1], voxel[0]);
  }
  bool
  operator<(const ContactVoxel & other) const
  {
    return Key() < other.Key();
  }
  bool
  operator==(const ContactVoxel & other) const
  {
    return Key() == other.Key();
  }
};

/** Two voxels that touch. */
struct TouchingPair
{
  ContactVoxel first;
  Voxel        second;
};

/** The neighbours that come later in scan order. */
std::vector<Voxel>
LaterNeighbours()
{
  std::vector<Voxel> steps;
  for (std::int32_t z = 0; z <= 1; ++z)
  {
    for (std::int32_t y = -1; y <= 1; ++y)
    {
      for (std::int32_t x = -1; x <= 1; ++x)
      {
        if (std::tuple(z, y, x) > std::tuple(0, 0, 0))
        {
          steps.push_back({ x, y, z });
        }
      }
    }
  }
  return steps;
}

std::vector<TouchingPair>
TouchingPairs(const std::vector<LabelShape> & labels)
{
  const LabelSlices          slices(labels);
  const VoxelBox &           box = slices.Box();
  const std::vector<Voxel>   steps = LaterNeighbours();
  std::vector<TouchingPair>  pairs;
  std::vector<std::uint32_t> slice;
  std::vector<std::uint32_t> next;
  const std::int32_t         last = box.lower[2] + box.size[2];
  slices.Read(box.lower[2], next);
  for (std::int32_t z = box.lower[2]; z < last; ++z)
  {
    std::swap(slice, next);
    slices.Read(z + 1, next);
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      for (std::int32_t x = 0; x < box.size[0]; ++x)
      {
        const auto at = [&](std::int32_t i, std::int32_t j) {
          return static_cast<std::size_t>(j) * static_cast<std::size_t>(box.size[0]) + static_cast<std::size_t>(i);
        };
        const std::uint32_t own = slice[at(x, y)];
        if (own == LabelSlices::kNoLabel)
        {
          continue;
        }
        for (const Voxel & step : steps)
        {
          const std::int32_t i = x + step[0];
          const std::int32_t j = y + step[1];
          if (i < 0 || j < 0 || i >= box.size[0] || j >= box.size[1])
          {
            continue;
          }
          const std::uint32_t other = (step[2] == 0 ? slice : next)[at(i, j)];
          if (other != own && other != LabelSlices::kNoLabel)
          {
            const Voxel voxel{ x + box.lower[0], y + box.lower[1], z };
            pairs.push_back({ { { std::min(own, other), std::max(own, other) }, voxel },
                              { voxel[0] + step[0], voxel[1] + step[1], voxel[2] + step[2] } });
          }
        }
      }
    }
  }
  return pairs;
}

} // namespace

LabelSlices::LabelSlices(const std::vector<LabelShape> & labels)
  : m_Labels(&labels)
{
  for (const LabelShape & label : labels)
  {
    m_Box = BoxOfBoth(m_Box, label.shape.Box());
  }
}

void
LabelSlices::Read(std::int32_t z, std::vector<std::uint32_t> & slice) const
{
  slice.assign(static_cast<std::size_t>(m_Box.size[0]) * static_cast<std::size_t>(m_Box.size[1]), kNoLabel);
  for (std::size_t number = 0; number < m_Labels->size(); ++number)
  {
    const VoxelShape & shape = (*m_Labels)[number].shape;
    const VoxelBox &   box = shape.Box();
    if (z < box.lower[2] || z >= box.lower[2] + box.size[2])
    {
      continue;
    }
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      const ConstShapeRow row = shape.Row(y, z - box.lower[2]);
      const std::size_t   from =
        static_cast<std::size_t>(y + box.lower[1] - m_Box.lower[1]) * static_cast<std::size_t>(m_Box.size[0]) +
        static_cast<std::size_t>(box.lower[0] - m_Box.lower[0]);
      for (std::size_t word = 0; word < row.size(); ++word)
      {
        for (std::uint64_t bits = row[word]; bits != 0; bits &= bits - 1)
        {
          slice[from + 64 * word + static_cast<std::size_t>(std::countr_zero(bits))] =
            static_cast<std::uint32_t>(number);
        }
      }
    }
  }
}

std::vector<LabelContact>
FindLabelContacts(const std::vector<LabelShape> & labels, const ImageGeometry & geometry)
{
  const std::vector<TouchingPair> pairs = TouchingPairs(labels);
  std::vector<ContactVoxel>       voxels;
  voxels.reserve(2 * pairs.size());
  for (const TouchingPair & pair : pairs)
  {
    voxels.push_back(pair.first);
    voxels.push_back({ pair.first.pair, pair.second });
  }
  std::sort(voxels.begin(), voxels.end());
  voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
  const auto number = [&](const ContactVoxel & voxel) {
    return static_cast<std::size_t>(std::lower_bound(voxels.begin(), voxels.end(), voxel) - voxels.begin());
  };

  UnionFind                places(voxels.size());
  const std::vector<Voxel> steps = LaterNeighbours();
  for (std::size_t i = 0; i < voxels.size(); ++i)
  {
    for (const Voxel & step : steps)
    {
      ContactVoxel neighbour = voxels[i];
      for (std::size_t axis = 0; axis < 3; ++axis)
      {
        neighbour.voxel[axis] += step[axis];
      }
      const std::size_t other = number(neighbour);
      if (other < voxels.size() && voxels[other] == neighbour)
      {
        places.Unite(i, other);
      }
    }
  }

  std::vector<LabelContact> contacts;
  std::vector<std::size_t>  contactOf(voxels.size(), 0); // of representatives, which come first in scan order
  for (std::size_t i = 0; i < voxels.size(); ++i)
  {
    const std::size_t first = places.Find(i);
    if (first == i)
    {
      contactOf[i] = contacts.size();
      contacts.emplace_back();
      contacts.back().labels = { voxels[i].pair[0], voxels[i].pair[1] };
    }
    contacts[contactOf[first]].voxels.push_back(voxels[i].voxel);
  }
  std::vector<std::array<std::int64_t, 3>>  sums(contacts.size(), { 0, 0, 0 }); // of both voxels of each pair
  std::vector<std::array<std::uint64_t, 3>> faces(contacts.size(), { 0, 0, 0 });
  std::vector<std::int64_t>                 counts(contacts.size(), 0);
  for (const TouchingPair & pair : pairs)
  {
    const std::size_t contact = contactOf[places.Find(number(pair.first))];
    std::size_t       across = 3;
    std::size_t       steps6 = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      sums[contact][axis] += std::int64_t{ pair.first.voxel[axis] } + pair.second[axis];
      if (pair.first.voxel[axis] != pair.second[axis])
      {
        across = axis;
        ++steps6;
      }
    }
    ++counts[contact];
    faces[contact][across] += steps6 == 1 ? 1 : 0;
  }
  for (std::size_t i = 0; i < contacts.size(); ++i)
  {
    LabelContact & contact = contacts[i];
    Vector3        middle{};
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      middle[axis] = 0.5 * static_cast<double>(sums[i][axis]) / static_cast<double>(counts[i]) + 0.5;
      contact.faces += faces[i][axis];
      contact.areaMm2 +=
        static_cast<double>(faces[i][axis]) * geometry.spacing[(axis + 1) % 3] * geometry.spacing[(axis + 2) % 3];
    }
    contact.centre = LatticeToPhysical(geometry, middle);
  }
  return contacts;
}

VoxelShape
UnionOfLabels(const std::vector<LabelShape> & labels)
{
  VoxelShape shape(LabelSlices(labels).Box());
  for (const LabelShape & label : labels)
  {
    PutInto(label.shape, shape);
  }
  shape.Compact();
  return shape;
}

namespace
{

/** Keeps the voxels for which `isKept(x, y, z)`. */
template <typename TKept>
void
KeepVoxels(LabelShape & label, const TKept & isKept)
{
  const VoxelBox & box = label.shape.Box();
  for (std::int32_t z = 0; z < box.size[2]; ++z)
  {
    for (std::int32_t y = 0; y < box.size[1]; ++y)
    {
      ShapeRow row = label.shape.Row(y, z);
      for (std::size_t word = 0; word < row.size(); ++word)
      {
        std::uint64_t kept = row[word];
        for (std::uint64_t bits = kept; bits != 0; bits &= bits - 1)
        {
          const auto x = static_cast<std::int32_t>(64 * word) + std::countr_zero(bits);
          if (!isKept(box.lower[0] + x, box.lower[1] + y, box.lower[2] + z))
          {
            kept &= ~(bits & (~bits + 1));
          }
        }
        row[word] = kept;
      }
    }
  }
  label.shape = CropToVoxels(std::move(label.shape));
  label.voxels = label.shape.CountVoxels();
}

void
DropEmpty(std::vector<LabelShape> & labels)
{
  std::erase_if(labels, [](const LabelShape & label) { return label.voxels == 0; });
}

} // namespace

std::vector<LabelShape>
WithoutSharedVoxels(std::vector<LabelShape> labels)
{
  std::uint64_t all = 0;
  for (const LabelShape & label : labels)
  {
    all += label.shape.CountVoxels();
  }
  if (all == UnionOfLabels(labels).CountVoxels())
  {
    return labels;
  }
  for (std::size_t i = labels.size(); i-- > 1;)
  {
    KeepVoxels(labels[i], [&](std::int32_t x, std::int32_t y, std::int32_t z) {
      return std::none_of(labels.begin(), labels.begin() + static_cast<std::ptrdiff_t>(i), [&](const LabelShape & one) {
        return one.shape.Contains(x, y, z);
      });
    });
  }
  DropEmpty(labels);
  return labels;
}

std::vector<LabelShape>
LabelsWithin(std::vector<LabelShape> labels, const VoxelShape & shape)
{
  for (LabelShape & label : labels)
  {
    KeepVoxels(label, [&](std::int32_t x, std::int32_t y, std::int32_t z) { return shape.Contains(x, y, z); });
  }
  DropEmpty(labels);
  return labels;
}

} // namespace voxelcore
