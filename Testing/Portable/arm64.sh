#!/bin/sh
# The program for 64-bit ARM, here; VOXELCORE_PORTABLE is the folder that build.sh built in.
exec qemu-aarch64 "$VOXELCORE_PORTABLE/linux-arm64/program/bin/voxelcore" "$@"
