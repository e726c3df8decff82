#include "VtkMessages.h"

#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkSmartPointer.h>

#include <mutex>

namespace voxelcore
{
namespace
{

class CollectingWindow : public vtkOutputWindow
{
public:
  static CollectingWindow *
  New();
  vtkTypeMacro(CollectingWindow, vtkOutputWindow);

  void
  DisplayText(const char * text) override
  {
    if (m_First.empty() && text)
    {
      m_First = text;
    }
  }
  const std::string &
  First() const
  {
    return m_First;
  }

private:
  std::string m_First;
};
vtkStandardNewMacro(CollectingWindow);

std::mutex &
WindowMutex()
{
  static std::mutex mutex;
  return mutex;
}

} // namespace

struct VtkMessages::State
{
  std::lock_guard<std::mutex>       lock{ WindowMutex() };
  vtkSmartPointer<vtkOutputWindow>  previous = vtkOutputWindow::GetInstance();
  vtkSmartPointer<CollectingWindow> window = vtkSmartPointer<CollectingWindow>::New();
  vtkLogger::Verbosity              verbosity = vtkLogger::GetCurrentVerbosityCutoff();
};

VtkMessages::VtkMessages()
  : m_State(std::make_unique<State>())
{
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  vtkOutputWindow::SetInstance(m_State->window);
}

VtkMessages::~VtkMessages()
{
  vtkOutputWindow::SetInstance(m_State->previous);
  vtkLogger::SetStderrVerbosity(m_State->verbosity);
}

std::string
VtkMessages::First() const
{
  // "ERROR: In /path/file.cxx, line 12\nvtkClass (0x55..): what happened\n\n"
  std::string text = m_State->window->First();
  if (const auto address = text.find("): "); address != std::string::npos)
  {
    text.erase(0, address + 3);
  }
  for (char & character : text)
  {
    if (character == '\n' || character == '\r' || character == '\t')
    {
      character = ' ';
    }
  }
  text.erase(text.find_last_not_of(" .") + 1);
  return text;
}

} // namespace voxelcore
