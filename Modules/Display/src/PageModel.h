#pragma once
// What a page shows, as text: a description in JSON and, apart from it, the numbers of all meshes in base64.

#include "voxelcore/HtmlPage.h"

#include <cstddef>
#include <string>
#include <vector>

namespace voxelcore
{

struct PageModel
{
  std::string json;    ///< valid JSON in which no `<` stands, so that no name can end the script it is put into
  std::string numbers; ///< base64
};

/** \throws Error where a place or a colour is not a finite number: JSON has no other numbers; Cancelled */
PageModel
MakePageModel(const DisplayContent & content, const HtmlOptions & options, const ProgressCallback & progress = {});

/** A mesh that asks for its part of a budget. */
struct MeshDemand
{
  std::size_t triangles = 0;
  double      weight = 1; ///< up to 1: how much a triangle of it matters
};

/** How many triangles of a budget each mesh gets: in proportion to its own, but a few dozen at least where that is to
 *  be had. */
std::vector<std::size_t>
SharesOfBudget(const std::vector<MeshDemand> & meshes, std::size_t budget);

} // namespace voxelcore
