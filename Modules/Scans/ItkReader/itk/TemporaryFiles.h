#pragma once

namespace voxelcore::itkreader
{

/** From here on, libraries of this process put their temporary files into a new folder (TMPDIR). A process of its own
 *  removes the folder when this one ends, however it ends: a library that crashes, throws or is killed leaves nothing
 *  behind. Standard error stays open until then. MINC's library needs it: it reads volumes of its first version through
 *  a temporary file, and forgets the file where a volume is damaged.
 *  \throws Error where no folder or process can be made. */
void
KeepTemporaryFilesApart();

} // namespace voxelcore::itkreader
