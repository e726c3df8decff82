#include "PageTexts.h"

// The assembler takes the files in as they are: a compiler would need minutes for a literal of this size.
#define VOXELCORE_EMBED(name, file)                                                                  \
  __asm__(".pushsection .rodata\n.global voxelcore_" #name "\nvoxelcore_" #name ":\n.incbin \"" file \
          "\"\n.global voxelcore_" #name "_end\nvoxelcore_" #name "_end:\n.byte 0\n.popsection\n");  \
  extern "C" const char voxelcore_##name[];                                                          \
  extern "C" const char voxelcore_##name##_end[];

VOXELCORE_EMBED(page, VOXELCORE_PAGE "/page.html")
VOXELCORE_EMBED(style, VOXELCORE_PAGE "/page.css")
VOXELCORE_EMBED(three, VOXELCORE_PAGE_THREE)
VOXELCORE_EMBED(data, VOXELCORE_PAGE "/data.js")
VOXELCORE_EMBED(meshes, VOXELCORE_PAGE "/meshes.js")
VOXELCORE_EMBED(overlay, VOXELCORE_PAGE "/overlay.js")
VOXELCORE_EMBED(view, VOXELCORE_PAGE "/view.js")
VOXELCORE_EMBED(panel, VOXELCORE_PAGE "/panel.js")
VOXELCORE_EMBED(edits, VOXELCORE_PAGE "/edits.js")

namespace voxelcore
{

const PageTextSet &
PageTexts()
{
  static const PageTextSet texts{ { voxelcore_page, voxelcore_page_end },
                                  { voxelcore_style, voxelcore_style_end },
                                  { voxelcore_three, voxelcore_three_end },
                                  { std::string_view(voxelcore_data, voxelcore_data_end),
                                    std::string_view(voxelcore_meshes, voxelcore_meshes_end),
                                    std::string_view(voxelcore_overlay, voxelcore_overlay_end),
                                    std::string_view(voxelcore_view, voxelcore_view_end),
                                    std::string_view(voxelcore_panel, voxelcore_panel_end),
                                    std::string_view(voxelcore_edits, voxelcore_edits_end) } };
  return texts;
}

} // namespace voxelcore
