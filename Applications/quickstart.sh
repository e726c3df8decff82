#!/usr/bin/env bash
# From a fresh clone on Debian 12 to the medial surfaces of a real scan, in one command.
# Installs what is missing, builds, and runs `voxelcore core` on the AAL brain atlas (116 labels, from Debian's package
# mricron-data). Everything it makes lies in build/. Run again, it does only what changed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

bash Applications/install-packages.sh build demo picture

scan=/usr/share/mricron/templates/aal.nii.gz
build=build/release
out=build/quickstart
if [ ! -r "$scan" ]; then
  echo "quickstart: $scan is missing although mricron-data is installed;" \
    "try 'apt-get install --reinstall mricron-data'" >&2
  exit 1
fi

mkdir -p "$out"
# Once configured, the build notices by itself what changed.
configure=(cmake -S . -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF)
if [ ! -e "$build/build.ninja" ] && ! "${configure[@]}" >"$out/configure.log" 2>&1; then
  cat "$out/configure.log" >&2
  exit 1
fi
cmake --build "$build" # all of it, so that `cmake --install` works afterwards

program=$build/bin/voxelcore
options=(--report "$out/aal_medial.json" --html "$out/aal.html" --force)
stamp=$(sha256sum "$scan" "$program" | cut -d' ' -f1 | tr '\n' ' ')"${options[*]}"
if [ -s "$out/aal_medial.vtp" ] && [ -s "$out/aal_medial.json" ] && [ -s "$out/table.txt" ] &&
   [ -s "$out/aal.html" ] && [ -s "$out/aal.png" ] && [ "$(cat "$out/stamp" 2>/dev/null)" = "$stamp" ]; then
  echo "Scan, options and program are those of the last run: its result is shown again."
else
  rm -f "$out/stamp"
  "$program" core "$scan" -o "$out/aal_medial.vtp" "${options[@]}" >"$out/table.txt"
  "$program" render "$out/aal_medial.vtp" --color Label --background dark --size 1600x1200 -o "$out/aal.png" \
    --force --quiet
  echo "$stamp" >"$out/stamp"
fi
cat "$out/table.txt"
echo
echo "Open this page in your browser:  $PWD/$out/aal.html"
echo "Look at this picture:            $PWD/$out/aal.png"
echo "For 3D Slicer and ParaView:      $PWD/$out/aal_medial.vtp"
echo "Report:                          $PWD/$out/aal_medial.json"
echo "Now your own scan:               $program core SCAN -o medial.vtp --html medial.html"
