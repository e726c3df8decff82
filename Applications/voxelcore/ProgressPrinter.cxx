#include "ProgressPrinter.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace voxelcore
{

void
ProgressPrinter::Show(std::string_view stage, double fraction)
{
  if (m_Style == Style::None)
  {
    return;
  }
  if (m_Style == Style::Bar)
  {
    ShowBar(stage, fraction);
    return;
  }
  const int step = static_cast<int>(fraction * (m_Style == Style::Json ? 100 : 10));
  if (step == m_Step && stage == m_Stage)
  {
    return;
  }
  m_Step = step;
  m_Stage = stage;
  if (m_Style == Style::Json)
  {
    nlohmann::ordered_json line;
    line["stage"] = m_Stage;
    line["fraction"] = static_cast<int>(fraction * 1000) / 1000.0;
    m_Console.PrintProgress(line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
    return;
  }
  char percent[16];
  static_cast<void>(std::snprintf(percent, sizeof(percent), "%3d %%  ", static_cast<int>(fraction * 100)));
  m_Console.PrintProgress(percent + m_Stage + "\n");
}

void
ProgressPrinter::ShowBar(std::string_view stage, double fraction)
{
  using namespace std::chrono_literals;
  // Short work needs no bar, and ten pictures a second are enough.
  const auto now = Clock::now();
  if (now - m_Start < 500ms || now - m_LastBar < 100ms)
  {
    return;
  }
  m_LastBar = now;
  m_BarIsUp = true;
  constexpr std::size_t width = 30;
  const auto            done = std::min(width, static_cast<std::size_t>(fraction * static_cast<double>(width)));
  char                  percent[16];
  static_cast<void>(std::snprintf(percent, sizeof(percent), "] %3d %%  ", static_cast<int>(fraction * 100)));
  m_Console.PrintProgress("\r[" + std::string(done, '#') + std::string(width - done, '.') + percent +
                          std::string(stage.substr(0, 35)) + "\x1b[K");
}

void
ProgressPrinter::Clear()
{
  if (m_BarIsUp)
  {
    m_Console.PrintProgress("\r\x1b[K");
    m_BarIsUp = false;
  }
}

} // namespace voxelcore
