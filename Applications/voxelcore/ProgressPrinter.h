#pragma once
// Progress on stderr, as a bar, as lines, or as JSON lines.

#include "Console.h"

#include <chrono>
#include <string>
#include <string_view>

namespace voxelcore
{

class ProgressPrinter
{
public:
  enum class Style
  {
    None,
    Bar,   ///< one line that is drawn over and over
    Plain, ///< a line per stage and per tenth
    Json   ///< {"stage":"..","fraction":0.42} per stage and per hundredth
  };

  ProgressPrinter(const Console & console, Style style)
    : m_Console(console)
    , m_Style(style)
  {}
  ProgressPrinter(const ProgressPrinter &) = delete;
  ProgressPrinter &
  operator=(const ProgressPrinter &) = delete;
  ~ProgressPrinter()
  {
    Clear();
  }

  void
  Show(std::string_view stage, double fraction);

  /** Takes the bar off the terminal. */
  void
  Clear();

private:
  void
  ShowBar(std::string_view stage, double fraction);

  using Clock = std::chrono::steady_clock;

  const Console &   m_Console;
  Style             m_Style;
  std::string       m_Stage;
  int               m_Step = -1; ///< the last tenth or hundredth shown
  bool              m_BarIsUp = false;
  Clock::time_point m_Start = Clock::now();
  Clock::time_point m_LastBar{};
};

} // namespace voxelcore
