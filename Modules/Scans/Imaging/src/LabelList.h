#pragma once
// Lists of names and colours that lie beside a scan.

#include "voxelcore/Labels/StoredVoxels.h"

#include <cstdint>
#include <filesystem>
#include <map>

namespace voxelcore
{

/** From "<scan without .gz>.txt", "<scan without extensions>.txt", or the same with .label, .ctab or .lut, beside the
 *  scan; the first that says anything gives the names, the first with colours the colours. A line each:
 *  - ITK-SNAP's label descriptions: value, red, green, blue (0 to 255), opacity, two flags, "name";
 *  - FreeSurfer's colour tables: value, name, red, green, blue, and one more number;
 *  - value, blank or tab, name; columns of numbers behind the name that every line has are dropped.
 *  Lines that do not begin with a number are ignored. A .lut of 768 bytes is MRIcron's: 256 reds, greens and blues.
 *  Of a FreeSurfer volume (.mgh, .mgz) that has none of these: FreeSurferColorLUT.txt beside it, else in
 *  $FREESURFER_HOME. Empty when there is no such file. */
std::map<std::int64_t, ListedLabel>
ReadLabelList(const std::filesystem::path & scan);

} // namespace voxelcore
