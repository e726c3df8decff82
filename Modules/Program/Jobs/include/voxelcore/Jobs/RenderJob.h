#pragma once
// `voxelcore render`: pictures of finished files.

#include "voxelcore/Jobs/JobContext.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace voxelcore
{

struct RenderJobOptions
{
  std::vector<std::filesystem::path>   files; ///< .vtp that 'voxelcore core' or 'voxelcore skeleton' wrote
  std::optional<std::filesystem::path> scan;  ///< whose surface is drawn around them; read as the files' record says
  std::string                          labels = "all"; ///< which of the files', by value or name
  std::filesystem::path                output;         ///< .png; with a turntable STEM_000.png and so on
  int                                  width = 1600;
  int                                  height = 1200;
  bool                                 shrink = true; ///< below these, where there would be broad margins
  std::string                          view = "auto";
  std::string                          coloring = "Radius";
  std::optional<std::array<double, 2>> range;                ///< mm at the ends of the colour map; else these shares
  std::array<double, 2>                shares{ 0.02, 0.98 }; ///< of the area shown
  std::optional<bool>                  eachLabel;            ///< each label over its own range; else where needed
  std::string                          background = "white";
  double                               tubes = 0.3;
  bool                                 panels = false;
  int                                  turntable = 1;
  bool                                 force = false;
};

struct RenderResult
{
  std::vector<std::filesystem::path> pictures;
  std::vector<std::string>           notes;
  std::vector<std::string>           warnings; ///< about the scan; a user must see them
};

/** Whether this build can draw. */
bool
HasDisplay();

/** \throws UsageError, InputError, OutputError, Cancelled */
RenderResult
RunRenderJob(const RenderJobOptions & options, const JobContext & context = {});

} // namespace voxelcore
