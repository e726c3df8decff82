#include "ShelvedTolerances.h"

#include <utility>

namespace voxelcore
{

ShelvedTolerances::Shelf::Shelf(std::vector<double> all, double height)
  : reaches(all.size())
{
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (all[i] >= height)
    {
      reaches[i] = true;
      values.push_back(all[i]);
    }
  }
}

std::vector<double>
ShelvedTolerances::Shelf::Take() const
{
  std::vector<double> all(reaches.size(), 0);
  std::size_t         next = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (reaches[i])
    {
      all[i] = values[next++];
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
  return { m_Vertices.Take(), m_Edges.Take(), m_Faces.Take() };
}

} // namespace voxelcore
