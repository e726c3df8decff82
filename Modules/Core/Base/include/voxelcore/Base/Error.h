#pragma once
// What can go wrong, as types. A program maps them to its exit codes; each message is one line that says what was
// wrong, in which file, and what to do.

#include <stdexcept>

namespace voxelcore
{

/** Anything VoxelCore throws on purpose. */
struct Error : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/** A caller's mistake: unknown option, a lambda without sense (exit 2). */
struct UsageError : Error
{
  using Error::Error;
};

/** Input that cannot be read, or cannot be worked on without guessing (exit 3). */
struct InputError : Error
{
  using Error::Error;
};

/** Output that cannot be written (exit 1). */
struct OutputError : Error
{
  using Error::Error;
};

/** A result that contradicts its own proof; never written (exit 4). */
struct CertificateError : Error
{
  using Error::Error;
};

/** The progress callback asked to stop (exit 130). */
struct Cancelled : Error
{
  Cancelled()
    : Error("interrupted")
  {}
};

} // namespace voxelcore
