#pragma once
// A page with everything in it, that shows a scan's labels in three dimensions in any browser, offline.

#include "voxelcore/Base/Progress.h"
#include "voxelcore/Models/DisplayContent.h"

#include <array>
#include <filesystem>
#include <string>

namespace voxelcore
{

struct HtmlOptions
{
  std::string title;
  std::size_t triangles = 500000; ///< at most about so many in the page; meshes beyond that are decimated for it
  bool        anatomical = true;  ///< whether the axes are known to be the patient's: else they are named x, y and z
  bool        byLabel = false;    ///< whether the page opens in the labels' colours
  std::string groups;             ///< what labels are to the reader ("Level"); their numbers are then not shown
  /** Axes of the content's space in the scan's, where they differ: places and directions are shown in the scan's. */
  std::array<std::array<double, 3>, 3> axes{ { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } };
  double      voxel = 0; ///< least spacing of the scan, where branches can be edited for `skeleton --edits`; else 0
  std::string figures;   ///< HTML shown below the labels, without scripts; the writer answers for it
};

/** Whether this build has the library that pages are made with (three.js). */
bool
HasHtml();

/** Writes one HTML file: meshes and values of `content`, three.js (MIT licence, named in the page) and a viewer. Places
 *  are rounded to 1/65535 of a mesh's box, values to 1/65534 of their range. Only what is shown is decimated; the page
 *  says from how many triangles. Its colours run from the 2nd to the 98th percentile; all values and each label's own
 *  are a choice. It asks nothing of any network, and forbids itself to. Damaged, or without WebGL, it says so.
 *  \throws UsageError where HasHtml() is false; Error where a place is no finite number; OutputError; Cancelled */
void
WriteHtml(const std::filesystem::path & path,
          const DisplayContent &        content,
          const HtmlOptions &           options,
          const ProgressCallback &      progress = {});

} // namespace voxelcore
