// Writes manual pages, completions of bash and zsh, and the table of options into a folder.
// usage: voxelcore_manual FOLDER

#include "Texts.h"
#include "voxelcore/Options/OptionsJson.h"

#include <filesystem>
#include <fstream>
#include <iostream>

int
main(int argc, char ** argv)
{
  using namespace voxelcore; // NOLINT: a program's only file speaks its library's language
  if (argc != 2)
  {
    std::cerr << "usage: voxelcore_manual FOLDER\n";
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  std::filesystem::create_directories(folder);
  bool       written = true;
  const auto write = [&](const std::string & name, const std::string & text) {
    std::ofstream file(folder / name);
    written = (file << text).flush().good() && written;
  };
  write("voxelcore.1", ProgramManual());
  for (const Command & command : Commands())
  {
    write("voxelcore-" + std::string(command.name) + ".1", CommandManual(command));
  }
  write("voxelcore.bash", BashCompletion());
  write("_voxelcore", ZshCompletion());
  write("options.json", OptionsJson(Commands()));
  if (!written)
  {
    std::cerr << "voxelcore_manual: " << folder.string() << ": cannot be written\n";
  }
  return written ? 0 : 1;
}
