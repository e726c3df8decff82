#!/usr/bin/env bash
# The program voxelcore out of an image, as if it were installed: in this folder, as this user.
# usage: voxelcore.sh COMMAND ...
# VOXELCORE_IMAGE: a .sif file or an image's name (voxelcore). VOXELCORE_RUNTIME: apptainer, singularity, podman or
# docker; the first that is there. VOXELCORE_BIND: further folders with data, separated by ':'.
# VOXELCORE_RUNTIME_OPTIONS: further options of its `exec` or `run`, separated by blanks.
set -euo pipefail
image=${VOXELCORE_IMAGE:-voxelcore}
runtime=${VOXELCORE_RUNTIME:-}
if [ -z "$runtime" ]; then
  for name in apptainer singularity podman docker; do
    if command -v "$name" >/dev/null; then runtime=$name; break; fi
  done
fi
[ -n "$runtime" ] || { echo "voxelcore.sh: there is no apptainer, singularity, podman or docker" >&2; exit 1; }

here=$(pwd -P)
folders=("$here")
IFS=: read -r -a more <<<"${VOXELCORE_BIND:-}"
for folder in "${more[@]}"; do
  [ -z "$folder" ] || folders+=("$(realpath "$folder")")
done
read -r -a binds <<<"${VOXELCORE_RUNTIME_OPTIONS:-}"
case "$runtime" in
  apptainer | singularity)
    for folder in "${folders[@]}"; do binds+=(--bind "$folder"); done
    exec "$runtime" exec --pwd "$here" "${binds[@]}" "$image" voxelcore "$@"
    ;;
  podman | docker)
    for folder in "${folders[@]}"; do binds+=(--volume "$folder:$folder"); done
    # Without rights podman gives this user another number inside, unless it is told to keep it.
    if [ "$runtime" = podman ] && [ "$(id -u)" != 0 ]; then binds+=(--userns=keep-id); fi
    exec "$runtime" run --rm --user "$(id -u):$(id -g)" "${binds[@]}" --workdir "$here" "$image" "$@"
    ;;
  *) echo "voxelcore.sh: VOXELCORE_RUNTIME=$runtime: expected apptainer, singularity, podman or docker" >&2; exit 2 ;;
esac
