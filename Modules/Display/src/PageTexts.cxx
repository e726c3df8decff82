#include "PageTexts.h"

// The assembler takes the files in as they are: a compiler would need minutes for a literal of this size.
#define VOXELCORE_EMBED(name, file)                                                                  \
  __asm__(".pushsection .rodata\n.global voxelcore_" #name "\nvoxelcore_" #name ":\n.incbin \"" file \
          "\"\n.global voxelcore_" #name "_end\nvoxelcore_" #name "_end:\n.byte 0\n.popsection\n");  \
  extern "C" const char voxelcore_##name[];                                                          \
  extern "C" const char voxelcore_##name##_end[];

VOXELCORE_EMBED(page, VOXELCORE_PAGE_HTML)
VOXELCORE_EMBED(viewer, VOXELCORE_PAGE_VIEWER)
VOXELCORE_EMBED(three, VOXELCORE_PAGE_THREE)
VOXELCORE_EMBED(controls, VOXELCORE_PAGE_CONTROLS)

namespace voxelcore
{

const PageTextSet &
PageTexts()
{
  static const PageTextSet texts{ { voxelcore_page, voxelcore_page_end },
                                  { voxelcore_viewer, voxelcore_viewer_end },
                                  { voxelcore_three, voxelcore_three_end },
                                  { voxelcore_controls, voxelcore_controls_end } };
  return texts;
}

} // namespace voxelcore
