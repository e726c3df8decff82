#include "PlainArrays.h"

#include "voxelcore/Base/Error.h"

#include <algorithm>
#include <utility>

namespace voxelcore
{

PlainArrays::Array &
PlainArrays::Add(const char * section, const std::string & name, std::uint64_t tuples, int components)
{
  Array & array = m_Arrays.emplace_back();
  array.section = section;
  array.name = name;
  array.tuples = tuples;
  array.components = components;
  return array;
}

double *
PlainArrays::Reals(const char * section, const char * name, std::uint64_t tuples, int components)
{
  Array & array = Add(section, name, tuples, components);
  array.isReal = true;
  array.reals.resize(array.Values());
  return array.reals.data();
}

std::int64_t *
PlainArrays::Wholes(const char * section, const char * name, std::uint64_t tuples, int components)
{
  Array & array = Add(section, name, tuples, components);
  array.wholes.resize(array.Values());
  return array.wholes.data();
}

void
PlainArrays::Take(const char * section, const std::string & name, std::vector<double> values, int components)
{
  Array & array = Add(section, name, values.size() / static_cast<std::size_t>(components), components);
  array.isReal = true;
  array.reals = std::move(values);
}

void
PlainArrays::Take(const char * section, const std::string & name, std::vector<std::int64_t> values)
{
  Add(section, name, values.size(), 1).wholes = std::move(values);
}

void
PlainArrays::Text(const char * name, const std::string & value)
{
  Array & array = Add("FieldData", name, 1, 1);
  array.isText = true;
  array.text = value;
}

ModelSink::CellBuffers<std::int32_t>
PlainArrays::NarrowCells(const char * section, std::uint64_t cells, std::uint64_t corners)
{
  const auto room = [&](const char * name, std::uint64_t count) {
    Array & array = Add(section, name, count, 1);
    array.isNarrow = true;
    array.indices.resize(count);
    return array.indices.data();
  };
  std::int32_t * const points = room("connectivity", corners);
  return { room("offsets", cells + 1), points };
}

ModelSink::CellBuffers<std::int64_t>
PlainArrays::WideCells(const char * section, std::uint64_t cells, std::uint64_t corners)
{
  std::int64_t * const points = Wholes(section, "connectivity", corners, 1);
  return { Wholes(section, "offsets", cells + 1, 1), points };
}

std::vector<const PlainArrays::Array *>
PlainArrays::Of(std::string_view section) const
{
  std::vector<const Array *> found;
  for (const Array & array : m_Arrays)
  {
    if (array.section == section)
    {
      found.push_back(&array);
    }
  }
  return found;
}

const PlainArrays::Array &
PlainArrays::Named(std::string_view section, std::string_view name) const
{
  const auto found = std::find_if(m_Arrays.begin(), m_Arrays.end(), [&](const Array & array) {
    return array.section == section && array.name == name;
  });
  if (found == m_Arrays.end())
  {
    throw Error("a model lacks the array " + std::string(name));
  }
  return *found;
}

} // namespace voxelcore
