#!/usr/bin/env bash
# The plugin in Debian's ParaView: three filters on a brain region of the AAL atlas, by the program and by the Python
# package; the picture and the state of show.py, which ParaView opens again.
# usage: paraview_test.sh BUILD_DIR      exit 77: ParaView is not there
# Debian's python3-paraview cannot be installed beside python3-vtk9; then it is unpacked into the build folder.
set -euo pipefail

build=$(realpath "$1")
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
scratch=$build/package-test/paraview
scan=/usr/share/mricron/templates/aal.nii.gz
fail() {
  echo "paraview_test.sh: $1" >&2
  exit 1
}
missing() {
  echo "paraview_test.sh: $1; 'bash Applications/install-packages.sh paraview' installs it" >&2
  exit 77
}
command -v pvbatch >/dev/null || missing "there is no ParaView"
command -v Xvfb >/dev/null || missing "there is no Xvfb"
[ -r "$scan" ] || missing "$scan is not there"

mkdir -p "$scratch"
path=''
if ! /usr/bin/python3 -c 'import paraview' 2>/dev/null; then
  path=$scratch/tree/usr/lib/python3/dist-packages
  if [ ! -d "$path/paraview" ]; then
    (cd "$scratch" && apt-get download -q python3-paraview >download.log 2>&1) || missing "there is no python3-paraview"
    dpkg -x "$scratch"/python3-paraview_*.deb "$scratch/tree"
  fi
fi
plugin=$build/lib/VoxelCore/paraview/VoxelCore.xml
# ParaView opens two connections one after the other; a server that starts anew between them refuses the second.
paraview() {
  PYTHONPATH=$path:$modules xvfb-run -a -s "-noreset -screen 0 1600x1200x24" pvbatch "$@"
}

for way in program package; do
  modules=''
  if [ "$way" = package ]; then
    # That of the build folder has Debian's VTK in it, beside which ParaView's cannot live in one process.
    modules=$build/package-test/wheel/unpacked
    [ -d "$modules/voxelcore" ] || { echo "package: not tried; Package.wheel makes it"; continue; }
  fi
  rm -rf "${scratch:?}/$way"
  mkdir "$scratch/$way"
  paraview "$source/Testing/ParaView/plugin_test.py" "$plugin" "$build/bin/voxelcore" "$scan" 37 "$scratch/$way" \
    "$way" >"$scratch/$way.log" 2>&1 ||
    { cat "$scratch/$way.log" >&2; fail "the filters do not do what the program does ($way)"; }
  grep -qx done "$scratch/$way.log" || fail "the test by the $way did not come to its end"
  grep -q '^voxelcore: /nowhere/voxelcore: it is no program;' "$scratch/$way.log" || fail "a wrong program is not named"
  grep "^$way:" "$scratch/$way.log"
done

modules=''
export PATH=$build/bin:$PATH
paraview "$source/Applications/ParaView/show.py" "$plugin" "$scratch/program/image.vti" "$scratch/shown" 37 \
  >"$scratch/show.log" 2>&1 || { cat "$scratch/show.log" >&2; fail "show.py failed"; }
cat >"$scratch/again.py" <<'END'
import sys
from paraview import simple
simple.LoadPlugin(sys.argv[1], remote=False)
simple.LoadState(sys.argv[2])
for name in ("VoxelCore1", "CurveSkeleton1"):
    found = simple.FindSource(name)
    found.UpdatePipeline()
    assert found.GetDataInformation().GetNumberOfPoints() > 10, name
print("opened")
END
paraview "$scratch/again.py" "$plugin" "$scratch/shown.pvsm" 2>"$scratch/again.log" | grep -qx opened ||
  { cat "$scratch/again.log" >&2; fail "the state does not open again"; }
# Not white, not grey alone: it has red curves and green sheets.
/usr/bin/python3 - "$scratch/shown.png" <<'END' || fail "the picture lacks the curve or the sheet"
import sys
import numpy
from PIL import Image
red, green, blue = numpy.asarray(Image.open(sys.argv[1]).convert("RGB")).astype(int).transpose(2, 0, 1)
assert ((red > green + 80) & (red > blue + 60)).sum() > 2000 and ((green > red + 40) & (green > 80)).sum() > 20000
END
echo "paraview: works"
