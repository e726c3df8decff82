// Two threads of one program at work at once: nothing is shared, so each gets what it would get alone.

#include "VoxelCoreTesting/Cores.h"

#include "voxelcore/VoxelCore/LambdaPruning.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

namespace voxelcore
{
namespace
{

using testing::ExpectSameCore;
using testing::Random;
using testing::RandomShape;

TEST(Concurrent, ThreadsComputeCoresAtOnceAsAlone)
{
  constexpr std::size_t count = 2;
  constexpr int         rounds = 3;
  Random                random(20);
  // Large enough for several bricks of the engine, so that each thread has helpers of its own.
  const std::array<VoxelShape, count> shapes{ RandomShape(random, { 44, 40, 36 }, 0.95),
                                              RandomShape(random, { 36, 44, 40 }, 0.9) };
  const SpacingWeights                weights = ComputeSpacingWeights({ 1, 1, 2 });
  const auto                          work = [&](std::size_t which) {
    return PruneByLambda(ComputeVoxelCore(shapes[which], weights, Engine::Lattice), { 0.9 }).front();
  };
  std::array<MedialComplex, count> alone;
  for (std::size_t i = 0; i < count; ++i)
  {
    alone[i] = work(i);
    ASSERT_GT(alone[i].cells.FaceCount(), 100U);
  }
  for (int round = 0; round < rounds; ++round)
  {
    std::array<MedialComplex, count> together;
    std::atomic<std::size_t>         ready = 0;
    std::vector<std::thread>         threads;
    for (std::size_t i = 0; i < count; ++i)
    {
      threads.emplace_back([&, i] {
        ++ready;
        while (ready < count)
        {
          std::this_thread::yield();
        }
        together[i] = work(i);
      });
    }
    for (std::thread & thread : threads)
    {
      thread.join();
    }
    for (std::size_t i = 0; i < count; ++i)
    {
      SCOPED_TRACE(i);
      ExpectSameCore(together[i], alone[i]);
    }
  }
}

} // namespace
} // namespace voxelcore
