#!/usr/bin/env bash
# Builds the program as WebAssembly, the npm package around it, and the page.
# usage: build.sh [FOLDER]     where to build (build-web). FOLDER/package is the package, FOLDER/*.tgz it packed;
# FOLDER/page the page for a web server, FOLDER/voxelcore.html the page as one file.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source_folder=$(cd "$here/../.." && pwd)
mkdir -p "${1:-build-web}"
build=$(cd "${1:-build-web}" && pwd)
bash "$here/../install-packages.sh" web
bash "$here/../portable/build.sh" wasm "$build"

# The package: the program, JavaScript around it, and the licences of all that is in it.
package=$build/package
rm -rf "$package"
mkdir -p "$package"
cp -r "$here/package/." "$package/"
cp "$here/README.md" "$source_folder/LICENSE" "$package/"
bash "$here/../portable/contents.sh" "$package" "$build/libraries" emscripten
cp "$build/program/bin/voxelcore.wasm" "$package/"
{ cat "$build/program/bin/voxelcore.js"; echo 'export default createVoxelCore;'; } >"$package/voxelcore.js"
version=$(sed -n 's/^project(VoxelCore VERSION \([0-9.]*\).*/\1/p' "$source_folder/CMakeLists.txt")
sed -i "s/\"version\": \"0.0.0\"/\"version\": \"$version\"/" "$package/package.json"
node "$here/types.js" "$package"
cd "$build"
npm pack --silent "$package" >packed
node "$here/page/build.mjs" "$package" "$build"
echo "$build/$(cat packed): $(stat -c %s "$(cat packed)") bytes"
