#pragma once
// What a page shows, as text: a description in JSON and, apart from it, the numbers of all meshes in base64.

#include "voxelcore/Display/HtmlPage.h"

#include <string>

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

} // namespace voxelcore
