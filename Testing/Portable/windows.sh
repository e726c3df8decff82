#!/bin/sh
# The program for Windows, here; VOXELCORE_PORTABLE is the folder that build.sh built in.
export WINEPREFIX="$VOXELCORE_PORTABLE/wine" WINEDEBUG=-all
mkdir -p "$WINEPREFIX"
# What Wine starts beside the first program would hold that one's output open: it is started here, and stays a minute.
if /usr/lib/wine/wineserver64 -p60 >/dev/null 2>&1 </dev/null; then
  wine cmd /c exit >/dev/null 2>&1 </dev/null
fi
exec wine "$VOXELCORE_PORTABLE/windows-x86_64/program/bin/voxelcore.exe" "$@"
