#include "voxelcore/Phantom/Phantom.h"

#include "Kinds.h"

#include "voxelcore/Base/DidYouMean.h"
#include "voxelcore/Base/Error.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace voxelcore
{
namespace
{

constexpr std::array<PhantomKind, 16> kKinds{ {
  { "ellipsoid", "an ellipsoid with semi-axes 0.45, 0.30 and 0.20 of the sides", "" },
  { "ball", "a ball", "radius (0.45 of the shortest side)" },
  { "capsule", "a straight rod along x with round ends", "radius (0.15 of the shortest side)" },
  { "box", "a box of 0.8 of the sides", "" },
  { "plate", "a flat plate across z, 0.9 of the sides x and y", "thickness (0.1 of the side z)" },
  { "rod", "a cylinder along z with flat ends, 0.9 of the side z", "radius (0.1 of the shortest side)" },
  { "torus", "a ring around z of radius 0.3 of the shortest side: one loop", "radius of the tube (0.12 of it)" },
  { "shell", "a ball with a cavity", "radius (0.45 of the shortest side), thickness (a third of the radius)" },
  { "tanglecube", "eight lumps joined along the edges of a cube: five loops", "" },
  { "gyroid",
    "a sheet along the gyroid, a surface that divides space",
    "period (0.35 of the shortest side), "
    "thickness (an eighth of the period)" },
  { "thick-and-thin",
    "a thick capsule with two rods and a plate on it, askew: what no single lambda prunes well",
    "radius of the rods (0.03 of the shortest side), thickness of the plate (0.05 of it)" },
  { "porous",
    "smooth noise above a threshold, as foam or bone",
    "density (0.5), period (a sixteenth of the shortest "
    "side, at least 2 voxels), seed" },
  { "noise", "each voxel in or out by chance, on its own", "density (0.5), seed" },
  { "root",
    "a branching root system along z: stem, laterals and their laterals",
    "seed, radius of the stem (0.045 of "
    "the shortest side), laterals, "
    "sub-laterals, whorls, contacts, detail" },
  { "cells",
    "a volume full of touching bodies, a label each, as in connectomics: branching neurites, bodies between them, "
    "fragments",
    "cells (2000), seed" },
  { "vessels",
    "twelve vessels, a label each, that meet in a ring as those at the base of the brain do: one loop",
    "radius of the stem (0.035 of the shortest side)" },
} };

void
CheckLength(const std::optional<double> & value, const char * name)
{
  if (value && !(std::isfinite(*value) && *value > 0))
  {
    throw UsageError(std::string("the ") + name + " of a phantom must be a number of mm above 0");
  }
}

const PhantomKind &
KindNamed(const std::string & name)
{
  std::string                   list;
  std::vector<std::string_view> names;
  for (const PhantomKind & kind : kKinds)
  {
    if (kind.name == name)
    {
      return kind;
    }
    list += (list.empty() ? "" : ", ") + std::string(kind.name);
    names.push_back(kind.name);
  }
  throw UsageError("there is no phantom '" + name + "'; the kinds are " + list + DidYouMean(name, names));
}

/** Another kind's option would be passed over without a word. */
void
CheckKindTakes(const PhantomOptions & options)
{
  const PhantomKind & kind = KindNamed(options.kind);
  const auto          check = [&](bool given, const char * name) {
    if (given && kind.options.find(name) == std::string_view::npos)
    {
      throw UsageError("the phantom " + options.kind + " takes no " + name +
                       (kind.options.empty() ? "" : "; it takes " + std::string(kind.options)));
    }
  };
  check(options.radius.has_value(), "radius");
  check(options.thickness.has_value(), "thickness");
  check(options.period.has_value(), "period");
  check(options.density.has_value(), "density");
  check(options.detail.has_value(), "detail");
  check(options.laterals.has_value(), "laterals");
  check(options.subLaterals.has_value(), "sub-laterals");
  check(options.whorls.has_value(), "whorls");
  check(options.contacts.has_value(), "contacts");
  check(options.cells.has_value(), "cells");
}

VoxelShape
Union(const PhantomOptions & options, const std::vector<VoxelShape> & bodies)
{
  VoxelShape all(VoxelBox{ { 0, 0, 0 }, options.size });
  for (const VoxelShape & body : bodies)
  {
    const VoxelBox & box = body.Box();
    for (std::int32_t z = box.lower[2]; z < box.lower[2] + box.size[2]; ++z)
    {
      for (std::int32_t y = box.lower[1]; y < box.lower[1] + box.size[1]; ++y)
      {
        for (std::int32_t x = box.lower[0]; x < box.lower[0] + box.size[0]; ++x)
        {
          if (body.Contains(x, y, z))
          {
            all.Insert(x, y, z);
          }
        }
      }
    }
  }
  return all;
}

} // namespace

void
CheckPhantomOptions(const PhantomOptions & options)
{
  for (const std::int32_t side : options.size)
  {
    if (side < 1 || side > (1 << 20))
    {
      throw UsageError("the size of a phantom must be 1 to 1048576 voxels along each axis");
    }
  }
  for (const double spacing : options.spacing)
  {
    if (!(std::isfinite(spacing) && spacing > 0))
    {
      throw UsageError("the spacing of a phantom must be a number of mm above 0 along each axis");
    }
  }
  CheckLength(options.radius, "radius");
  CheckLength(options.thickness, "thickness");
  CheckLength(options.period, "period");
  CheckLength(options.detail, "detail");
  CheckKindTakes(options);
  if (options.period && *options.period < 2 * *std::min_element(options.spacing.begin(), options.spacing.end()))
  {
    throw UsageError("the period of a phantom must be at least two voxels");
  }
  if (options.density && !(*options.density >= 0 && *options.density <= 1))
  {
    throw UsageError("the density of a phantom must be between 0 and 1");
  }
  for (const std::optional<int> & count : { options.laterals, options.subLaterals, options.whorls, options.contacts })
  {
    if (count && (*count < 0 || *count > 10000))
    {
      throw UsageError("the numbers of laterals, whorls and contacts of a root must be between 0 and 10000");
    }
  }
  if (options.cells && (*options.cells < 1 || *options.cells > 1000000))
  {
    throw UsageError("the number of cells must be between 1 and 1000000");
  }
}

std::span<const PhantomKind>
PhantomKinds()
{
  return kKinds;
}

VoxelShape
MakePhantom(const PhantomOptions & options, const ProgressCallback & progress)
{
  CheckPhantomOptions(options);
  if (std::optional<VoxelShape> solid = MakeSolid(options, progress))
  {
    return std::move(*solid);
  }
  if (options.kind == "porous")
  {
    return MakePorous(options, progress);
  }
  if (options.kind == "noise")
  {
    return MakeNoise(options, progress);
  }
  if (options.kind == "root")
  {
    return MakeRoot(options, progress);
  }
  return Union(options, MakePhantomBodies(options, progress));
}

std::vector<VoxelShape>
MakePhantomBodies(const PhantomOptions & options, const ProgressCallback & progress)
{
  CheckPhantomOptions(options);
  if (options.kind == "cells")
  {
    return MakeCells(options, progress);
  }
  if (options.kind == "vessels")
  {
    return MakeVessels(options, progress);
  }
  std::vector<VoxelShape> one;
  one.push_back(CropToVoxels(MakePhantom(options, progress)));
  return one;
}

std::vector<CentreLinePoint>
RootCentreLines(const PhantomOptions & options)
{
  CheckPhantomOptions(options);
  if (options.kind != "root")
  {
    throw UsageError("only the phantom 'root' has known centre lines; choose it");
  }
  return CentreLinesOfRoot(options);
}

std::vector<RootContact>
RootContacts(const PhantomOptions & options)
{
  CheckPhantomOptions(options);
  if (options.kind != "root")
  {
    throw UsageError("only the phantom 'root' has known contacts; choose it");
  }
  return ContactsOfRoot(options);
}

} // namespace voxelcore
