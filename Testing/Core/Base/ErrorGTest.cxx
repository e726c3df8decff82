#include "voxelcore/Base/Error.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace voxelcore::testing
{
namespace
{

/** The exit code that the first handler gives to which an error goes, as a program asks for them. */
template <typename... TInOrder>
int
CodeOf(const std::function<void()> & fail, const std::vector<int> & codes)
{
  std::size_t handler = 0;
  int         code = -1;
  const auto  ask = [&]<typename TError>() {
    if (code < 0)
    {
      try
      {
        fail();
      }
      catch (const TError &)
      {
        code = codes[handler];
      }
      catch (...)
      {}
    }
    ++handler;
  };
  (ask.template operator()<TInOrder>(), ...);
  return code;
}

TEST(Error, EachKindHasItsExitCodeInWhicheverOrderAProgramAsks)
{
  const std::vector<std::pair<std::function<void()>, int>> failures{
    { [] { throw OutputError("a.vtp: cannot be written"); }, 1 },
    { [] { throw UsageError("--lambda -1: below 0"); }, 2 },
    { [] { throw InputError("a.nrrd: is cut off"); }, 3 },
    { [] { throw CertificateError("label 1: b1 differs"); }, 4 },
    { [] { throw Cancelled(); }, 130 },
    { [] { throw Error("anything else"); }, 5 },
  };
  for (const auto & [fail, code] : failures)
  {
    EXPECT_EQ(
      (CodeOf<OutputError, UsageError, InputError, CertificateError, Cancelled, Error>(fail, { 1, 2, 3, 4, 130, 5 })),
      code);
    EXPECT_EQ(
      (CodeOf<Cancelled, CertificateError, InputError, UsageError, OutputError, Error>(fail, { 130, 4, 3, 2, 1, 5 })),
      code);
  }
}

TEST(Error, AStandardHandlerGetsTheLine)
{
  const auto line = [](const auto & error) {
    try
    {
      throw error;
    }
    catch (const std::runtime_error & caught)
    {
      return std::string(caught.what());
    }
  };
  EXPECT_EQ(line(Error("a")), "a");
  EXPECT_EQ(line(UsageError("b")), "b");
  EXPECT_EQ(line(InputError("c")), "c");
  EXPECT_EQ(line(OutputError("d")), "d");
  EXPECT_EQ(line(CertificateError("e")), "e");
  EXPECT_EQ(line(Cancelled()), "interrupted");
}

} // namespace
} // namespace voxelcore::testing
