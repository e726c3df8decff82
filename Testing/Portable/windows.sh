#!/bin/sh
# The program for Windows, here; VOXELCORE_PORTABLE is the folder that build.sh built in.
export WINEPREFIX="$VOXELCORE_PORTABLE/wine" WINEDEBUG=-all
exec wine "$VOXELCORE_PORTABLE/windows-x86_64/program/bin/voxelcore.exe" "$@"
