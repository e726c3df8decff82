#pragma once
// A folder in which jobs run on small phantoms.

#include "VoxelCoreTesting/TemporaryFolder.h"

#include "voxelcore/Phantom/PhantomCommand.h"
#include "voxelcore/Base/Error.h"
#include "voxelcore/Options/Requests.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <string_view>

namespace voxelcore::testing
{

class JobFolder : public ::testing::Test
{
protected:
  std::string
  At(const std::string & name) const
  {
    return (m_Folder.Path() / name).string();
  }
  std::set<std::string>
  Names() const
  {
    return m_Folder.Names();
  }
  std::string
  Bytes(const std::string & name) const
  {
    const std::string bytes = ReadAll(At(name));
    EXPECT_FALSE(bytes.empty()) << name;
    return bytes;
  }
  void
  Phantom(const std::string & kind, const std::string & name, const std::string & size = "20") const
  {
    ParameterValues values{ { "kind", kind }, { "size", size }, { "output", At(name) } };
    if (kind == "cells")
    {
      values["cells"] = "8"; // large enough not to be taken for grey values
    }
    RunPhantomJob(PhantomOptionsFrom(values));
  }
  /** The core of a.nrrd, unless `more` says otherwise. */
  CoreResult
  Core(const std::string & output, ParameterValues more = {}) const
  {
    more.insert({ { "scan", At("a.nrrd") }, { "output", At(output) } });
    return RunCoreJob(CoreOptionsFrom(more));
  }
  /** A cube of 2 x 4 x 6 mm with its lowest corner at (1, 2, 3). */
  void
  BoxMesh(const std::string & name) const
  {
    std::string text = "OFF\n8 6 0\n";
    for (int i = 0; i < 8; ++i)
    {
      text += std::to_string(1 + (i & 1) * 2) + " " + std::to_string(2 + (i >> 1 & 1) * 4) + " " +
              std::to_string(3 + (i >> 2 & 1) * 6) + "\n";
    }
    WriteAll(At(name), text + "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n");
  }

  TemporaryFolder m_Folder;
};

/** A job that is stopped when it first tells of its progress after `calls` times. */
inline JobContext
StoppingAfter(int calls)
{
  JobContext context;
  context.progress = [calls](std::string_view, double) mutable { return calls-- > 0; };
  return context;
}

/** Notes how far the job came. */
inline JobContext
Noting(double & fraction)
{
  JobContext context;
  context.progress = [&fraction](std::string_view, double now) {
    fraction = std::max(fraction, now);
    return true;
  };
  return context;
}

} // namespace voxelcore::testing
