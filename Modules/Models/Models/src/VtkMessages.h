#pragma once
// Keeps what VTK would print, as long as the object lives.

#include <memory>
#include <string>

namespace voxelcore
{

/** VTK reports trouble by printing to stderr from wherever it happens. While an object of this class lives, errors and
 *  warnings are collected instead, from all VTK objects of the process; objects exclude each other across threads. */
class VtkMessages
{
public:
  VtkMessages();
  VtkMessages(const VtkMessages &) = delete;
  VtkMessages &
  operator=(const VtkMessages &) = delete;
  ~VtkMessages();

  /** The first message in one line, without VTK's file names and addresses; empty when all went well. */
  std::string
  First() const;

private:
  struct State;
  std::unique_ptr<State> m_State;
};

} // namespace voxelcore
