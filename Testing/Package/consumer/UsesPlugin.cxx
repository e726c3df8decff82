// Loads the plugin, which must do its work and tell errors apart. usage: UsesPlugin ./libPlugin.so SCAN OUT.vtp

#include <cstdio>
#include <dlfcn.h>

int
main(int argc, char ** argv)
{
  void * plugin = argc == 4 ? dlopen(argv[1], RTLD_NOW | RTLD_LOCAL) : nullptr;
  if (plugin == nullptr)
  {
    std::fprintf(stderr, "%s\n", argc == 4 ? dlerror() : "usage");
    return 2;
  }
  using Function = int (*)(const char *, const char *);
  const auto makesCore = reinterpret_cast<Function>(dlsym(plugin, "PluginMakesCore"));
  // Done; there already; an extension that is none; no such scan.
  const bool right = makesCore(argv[2], argv[3]) == 0 && makesCore(argv[2], argv[3]) == 1 &&
                     makesCore(argv[2], "never-written.xyz") == 2 &&
                     makesCore("/nowhere.nrrd", "never-written.vtp") == 3;
  return right ? 0 : 1;
}
