#pragma once
// What is said where something is refused.

#include "voxelcore/Base/Error.h"

#include <gtest/gtest.h>

#include <string>

namespace voxelcore::testing
{

/** The words of the error that `work` throws. The test fails where it throws none. */
template <typename TError = InputError, typename TWork>
std::string
MessageOf(const TWork & work)
{
  try
  {
    work();
  }
  catch (const TError & error)
  {
    return error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

} // namespace voxelcore::testing
