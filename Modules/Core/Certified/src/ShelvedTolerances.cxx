#include "ShelvedTolerances.h"

#include <utility>

namespace voxelcore
{

ShelvedTolerances::Shelf::Shelf(std::vector<double> all, double height)
  : reaches(all.size())
{
  std::vector<double> some;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (all[i] >= height)
    {
      reaches[i] = true;
      some.push_back(all[i]);
    }
  }
  std::vector<double>().swap(all);
  values = PackedArray<double>(std::move(some));
}

std::vector<double>
ShelvedTolerances::Shelf::Take() &&
{
  std::vector<double>       all(reaches.size(), 0);
  const std::vector<double> some = std::move(values).Take();
  std::size_t               next = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (reaches[i])
    {
      all[i] = some[next++];
    }
  }
  return all;
}

ShelvedTolerances::ShelvedTolerances(ToleranceValues values, double height)
  : m_Vertices(std::move(values.vertices), height)
  , m_Edges(std::move(values.edges), height)
  , m_Faces(std::move(values.faces), height)
{}

ToleranceValues
ShelvedTolerances::Take() &&
{
  return { std::move(m_Vertices).Take(), std::move(m_Edges).Take(), std::move(m_Faces).Take() };
}

} // namespace voxelcore
