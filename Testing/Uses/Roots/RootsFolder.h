#pragma once

#include "Program/Jobs/JobFolder.h"

#include "voxelcore/Roots/RootsCommand.h"
#include "voxelcore/Roots/RootsJob.h"

#include <filesystem>
#include <set>
#include <string>
#include <utility>

namespace voxelcore::testing
{

/** A folder with scans of a root phantom, and runs of `roots` on them. */
class RootsFolder : public JobFolder
{
protected:
  PhantomJobOptions
  Scan(const std::string & name, double hollow = 0, int contacts = 0) const
  {
    PhantomJobOptions options;
    options.phantom.kind = "root";
    options.phantom.size = { 96, 96, 96 };
    options.phantom.seed = 3;
    options.phantom.radius = 6;
    options.phantom.laterals = 6;
    options.phantom.subLaterals = 1;
    options.phantom.contacts = contacts;
    options.output = At(name);
    options.scan.emplace();
    options.scan->hollow = hollow;
    options.scan->holes = hollow > 0 ? 4 : 0;
    options.scan->noise = 0.05;
    RunPhantomJob(options);
    return options;
  }

  RootsResult
  Roots(const std::string & scan, const std::string & output, ParameterValues more = {}) const
  {
    return Roots(scan, output, std::move(more), RootRules().tornGap);
  }

  RootsResult
  Roots(const std::string & scan, const std::string & output, ParameterValues more, double tornGap) const
  {
    more.insert({ { "scan", At(scan) }, { "output", At(output) }, { "no-pictures", "true" } });
    RootsOptions options = RootsOptionsFrom(more);
    options.rules.tornGap = tornGap;
    return RunRootsJob(options);
  }

  std::set<std::string>
  In(const std::string & folder) const
  {
    std::set<std::string> names;
    for (const auto & entry : std::filesystem::directory_iterator(At(folder)))
    {
      names.insert(entry.path().filename().string());
    }
    return names;
  }
};

} // namespace voxelcore::testing
