#include "Ending.h"

#include <cstring>
#include <unistd.h>

namespace voxelcore
{

namespace
{

constexpr char            kNothing[] = "nothing was written";
std::atomic<const char *> leftBehind{ kNothing };

} // namespace

void
Say(const char * text)
{
  static_cast<void>(!write(errorStream.load(), text, static_cast<unsigned>(std::strlen(text))));
}

void
SayWhatIsLeft(const char * before, const char * after)
{
  Say(before);
  Say(WhatIsLeft());
  Say(after);
}

void
SayCrash()
{
  SayWhatIsLeft("voxelcore: internal error: the program crashed; ", "; please report this with the scan\n");
}

void
RemoveTemporaries()
{
  if (const TemporaryRegistry * const registry = temporaries.load())
  {
    registry->RemoveAllNow();
  }
}

void
SayThatIsLeft(const char * text)
{
  leftBehind = text;
}

const char *
WhatIsLeft()
{
  const char * const              left = leftBehind.load();
  const TemporaryRegistry * const registry = temporaries.load();
  return left == kNothing && registry != nullptr && registry->HasCommitted()
           ? "the files that have their names are complete"
           : left;
}

void
EndByItself()
{
  endsByItself = true;
}

} // namespace voxelcore
