#include "TiffFile.h"

#include "voxelcore/Base/TextFields.h"

namespace voxelcore
{

bool
AreAlike(const TiffPages & a, const TiffPages & b)
{
  return a.width == b.width && a.height == b.height && a.type == b.type && a.bits == b.bits && a.samples == b.samples &&
         a.minIsWhite == b.minIsWhite;
}

void
DescribeTiff(const TiffPages & pages, ScanFile & scan)
{
  scan.type = pages.type;
  if (pages.bits < 8)
  {
    scan.storedType = Text("uint", pages.bits);
  }
  if (pages.minIsWhite)
  {
    scan.notes.push_back("pages show 0 as white; values are taken as stored");
  }
  if (pages.channelsAreSlices)
  {
    scan.warnings.push_back("ImageJ calls its pages channels; so many are taken for slices (--component 0 takes one)");
  }
  if (pages.behind)
  {
    scan.notes.push_back(Text("a stack of ImageJ's above 4 GB: of its ",
                              pages.behind->slices,
                              " pages the file lists the first, and the others lie behind it"));
  }
  if (pages.lossy)
  {
    scan.warnings.push_back(
      "its pages are in a lossy compression, which may have changed labels when the file was written");
  }
}

} // namespace voxelcore
