#pragma once
// Shapes and requests for tests of certified results.

#include "voxelcore/Certified/Certified.h"

#include <string>
#include <vector>

namespace voxelcore
{

inline VoxelShape
Box(std::int32_t x, std::int32_t y, std::int32_t z)
{
  VoxelShape shape(VoxelBox{ { 2, 3, 4 }, { x, y, z } });
  for (std::int32_t k = 0; k < z; ++k)
  {
    for (std::int32_t j = 0; j < y; ++j)
    {
      for (std::int32_t i = 0; i < x; ++i)
      {
        shape.Insert(2 + i, 3 + j, 4 + k);
      }
    }
  }
  return shape;
}

inline ImageGeometry
Grid(const Vector3 & spacing)
{
  ImageGeometry geometry;
  geometry.size = { 40, 40, 40 };
  geometry.spacing = spacing;
  return geometry;
}

inline CertifiedRequest
Lambdas(const std::vector<std::string> & texts)
{
  CertifiedRequest request;
  request.lambdas.clear();
  for (const std::string & text : texts)
  {
    request.lambdas.push_back(ParseLambda(text));
  }
  return request;
}

inline SkeletonRequest
Skeleton()
{
  SkeletonRequest request;
  request.standOut = ParseLambda("3vox");
  request.smooth = ParseLambda("6vox");
  return request;
}

} // namespace voxelcore
