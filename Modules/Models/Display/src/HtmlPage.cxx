#include "voxelcore/Display/HtmlPage.h"

#include "PageModel.h"
#include "PageTexts.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Base/OutputFile.h"

#include <string_view>
#include <utility>

namespace voxelcore
{

#ifdef VOXELCORE_HAS_THREE

bool
HasHtml()
{
  return true;
}

void
WriteHtml(const std::filesystem::path & path,
          const DisplayContent &        content,
          const HtmlOptions &           options,
          const ProgressCallback &      progress)
{
  const PageModel model = MakePageModel(content, options, progress);
  std::string     page(PageTexts().page);
  std::string     viewer;
  for (const std::string_view script : PageTexts().scripts)
  {
    viewer += script;
  }
  // Each text takes the place of its mark, once, from the end on: marks that data may hold are left alone.
  const std::pair<std::string_view, std::string_view> texts[] = {
    { "@VIEWER@", viewer },    { "@THREE@", PageTexts().three }, { "@DATA@", model.numbers },
    { "@MODEL@", model.json }, { "@FIGURES@", options.figures }, { "@STYLE@", PageTexts().style }
  };
  for (const auto & [mark, text] : texts)
  {
    const auto place = page.find(mark);
    if (place == std::string::npos)
    {
      throw Error("the page lacks its mark " + std::string(mark));
    }
    page.replace(place, mark.size(), text);
  }
  WriteTextFile(path, page);
}

#else

bool
HasHtml()
{
  return false;
}

void
WriteHtml(const std::filesystem::path &, const DisplayContent &, const HtmlOptions &, const ProgressCallback &)
{
  throw UsageError("--html is off in this build: install three.js (Debian: libjs-three) and configure it anew");
}

#endif

} // namespace voxelcore
