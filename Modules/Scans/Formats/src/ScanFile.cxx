#include "voxelcore/Formats/ScanFile.h"

#include "voxelcore/Base/TextFields.h"

namespace voxelcore
{

void
NoteOneSlice(std::size_t slices, ScanFile & scan)
{
  if (slices == 1)
  {
    scan.warnings.emplace_back("one slice: the volume is one voxel thick");
  }
}

std::vector<std::string>
WarningsOf(const ScanFile & scan)
{
  const auto               path = scan.path.has_filename() ? scan.path : scan.path.parent_path(); // "folder/"
  std::vector<std::string> warnings;
  for (const std::string & warning : scan.warnings)
  {
    warnings.push_back(Text(Printable(path.filename().string(), 200), ": ", warning));
  }
  return warnings;
}

void
SetGeometry(ScanFile &                     scan,
            const std::array<Vector3, 3> & axes,
            const Vector3 &                spacing,
            const Vector3 &                origin,
            const ReadOptions &            options)
{
  scan.geometry =
    CheckedGeometry(scan.path, { scan.geometry.size, axes, spacing, origin, scan.geometry.unit }, options, scan.notes);
}

std::uint64_t
ChooseVolume(const std::filesystem::path & path, std::uint64_t volumes, const ReadOptions & options)
{
  if (!options.volume)
  {
    if (volumes > 1)
    {
      RefuseInput(path,
                  Text("4-D file with ", volumes, " volumes"),
                  Text("choose one with --volume 0 to --volume ", volumes - 1));
    }
    return 0;
  }
  if (*options.volume < 0 || static_cast<std::uint64_t>(*options.volume) >= volumes)
  {
    RefuseInput(path,
                Text("there is no volume ", *options.volume, ", it has ", volumes),
                Text("volumes are counted from 0 to ", volumes - 1));
  }
  return static_cast<std::uint64_t>(*options.volume);
}

std::uint64_t
ChooseComponent(const std::filesystem::path & path,
                std::uint64_t                 components,
                std::string_view              kind,
                const ReadOptions &           options)
{
  if (!options.component)
  {
    if (components > 1)
    {
      RefuseInput(
        path,
        Text(kind, " (", components, " values a voxel)"),
        Text("save its labels as one whole number a voxel, or choose one value with --component 0 to --component ",
             components - 1));
    }
    return 0;
  }
  if (*options.component < 0 || static_cast<std::uint64_t>(*options.component) >= components)
  {
    RefuseInput(path,
                Text("there is no component ", *options.component, ", a voxel has ", components),
                Text("components are counted from 0 to ", components - 1));
  }
  return static_cast<std::uint64_t>(*options.component);
}

} // namespace voxelcore
