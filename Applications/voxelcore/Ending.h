#pragma once
// What the program's ends have in common on every system. Handlers call these functions, so none allocates or locks.

#include "Signals.h"

#include <atomic>

namespace voxelcore
{

inline constexpr int kLooks = 40; ///< whether files have got their names, `kToCommit` apart; then a file system hangs
inline constexpr int kToCommit = 50; ///< ms
inline constexpr int kToStop = 500;  ///< ms for a job to stop by itself

/** Of the program's output; none before HandleSignals(). */
inline std::atomic<const TemporaryRegistry *> temporaries{ nullptr };
inline std::atomic<int>                       errorStream{ 2 };
inline std::atomic<bool>                      interrupted{ false };
inline std::atomic<bool>                      endsByItself{ false };

void
Say(const char * text);

/** `before`, what is left, `after`. */
void
SayWhatIsLeft(const char * before, const char * after = "\n");

void
SayCrash();

void
RemoveTemporaries();

} // namespace voxelcore
