#pragma once
// A folder in which the thickness of small labels is measured.

#include "Program/Jobs/JobFolder.h"

#include "voxelcore/Thickness/ThicknessCommand.h"
#include "voxelcore/Imaging/GreyVolume.h"
#include "voxelcore/Thickness/ThicknessJob.h"

#include <cmath>
#include <string>
#include <utility>

namespace voxelcore::testing
{

class ThicknessFolder : public JobFolder
{
protected:
  ThicknessResult
  Thickness(const std::string & output, ParameterValues more = {}, const JobContext & context = {}) const
  {
    more.insert({ { "scan", At("a.nrrd") }, { "output", At(output) } });
    return RunThicknessJob(ThicknessOptionsFrom(more), context);
  }

  /** A slab of 6 voxels across z, and a ball of radius 5, as labels 1 and 2. */
  void
  TwoLabels(const Vector3 & spacing = { 1, 1, 1 }) const
  {
    VoxelShape slab(VoxelBox{ { 4, 4, 4 }, { 32, 32, 6 } });
    VoxelShape ball(VoxelBox{ { 10, 10, 20 }, { 12, 12, 12 } });
    for (std::int32_t z = 0; z < 12; ++z)
    {
      for (std::int32_t y = 0; y < 32; ++y)
      {
        for (std::int32_t x = 0; x < 32; ++x)
        {
          if (z < 6)
          {
            slab.Insert(4 + x, 4 + y, 4 + z);
          }
          if (x < 12 && y < 12 && std::hypot(x - 5.5, y - 5.5, z - 5.5) < 5)
          {
            ball.Insert(10 + x, 10 + y, 20 + z);
          }
        }
      }
    }
    ImageGeometry geometry;
    geometry.size = { 40, 40, 36 };
    geometry.spacing = spacing;
    const std::uint64_t voxels = ball.CountVoxels();
    WriteLabelVolume(At("a.nrrd"),
                     geometry,
                     { { 1, "slab", 32 * 32 * 6, std::move(slab) }, { 2, "ball", voxels, std::move(ball) } });
  }

  GreyVolume
  Map(const std::string & name) const
  {
    return ReadGreyVolume(At(name), VoxelBox{ { 0, 0, 0 }, { 40, 40, 36 } });
  }
};

} // namespace voxelcore::testing
