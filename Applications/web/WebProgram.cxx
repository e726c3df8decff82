// What MainStack.cxx and Signals.cxx do elsewhere, and the table of options for a page's forms. Here the stack has its
// size from the start, and nothing but the page or Node ends the program: it asks for that by Module.isCancelled().

#include "../voxelcore/Ending.h"
#include "../voxelcore/MainStack.h"
#include "voxelcore/Options/OptionsJson.h"

#include <emscripten.h>
#include <string>

EM_JS(int, IsCancelledByCaller, (), { return Module["isCancelled"] && Module["isCancelled"]() ? 1 : 0; });

// OptionsJson(); the text lives as long as the program.
extern "C" EMSCRIPTEN_KEEPALIVE const char *
ParameterTable()
{
  static const std::string text = voxelcore::OptionsJson(voxelcore::Commands());
  return text.c_str();
}

namespace voxelcore
{

void
ReserveMainStack()
{}

int
RunWithStack(const std::function<int()> & work)
{
  return work();
}

void
HandleSignals(const TemporaryRegistry & registry, int)
{
  temporaries = &registry;
}

bool
WasInterrupted()
{
  return IsCancelledByCaller() != 0;
}

void
CallOffDeadline()
{}

} // namespace voxelcore
