#!/usr/bin/env bash
# Looks through the sources of modules and programs without running them. Non-zero when something is found that is
# neither mended nor on the kept list: cppcheck.txt, and for clang-tidy .clang-tidy and NOLINT beside the line, each
# with its reason.
# usage: analyse.sh cppcheck|clang-tidy BUILD_DIR [FOLDER...]    say Modules/Core/Base; all of Modules and Applications
# by default; exit 77: a tool is missing
set -euo pipefail
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
kind=$1
mkdir -p "$2"
build=$(cd "$2" && pwd)
shift 2
cd "$source"
folders=("$@")
if [ ${#folders[@]} -eq 0 ]; then
  folders=(Modules Applications)
fi
for folder in "${folders[@]}"; do
  [ -d "$folder" ] || { echo "analyse.sh: there is no $folder" >&2; exit 2; }
done
# One processor fewer than there are, and never in the way of others.
jobs=$(($(nproc) > 1 ? $(nproc) - 1 : 1))

case "$kind" in
  cppcheck)
    command -v cppcheck >/dev/null || { echo "analyse.sh: no cppcheck here" >&2; exit 77; }
    include=()
    for folder in Modules/*/*/; do
      include+=(-I "${folder}include" -I "${folder}inner" -I "${folder}src" -I "${folder}job" \
        -I "${folder}tables")
    done
    nice cppcheck -q -j "$jobs" --std=c++20 --language=c++ --enable=warning,performance,portability --inline-suppr \
      --suppressions-list=Testing/Analysis/cppcheck.txt --template='{file}:{line}: {severity} {id}: {message}' \
      --cppcheck-build-dir="$build" --error-exitcode=1 "${include[@]}" "${folders[@]}"
    ;;
  clang-tidy)
    if ! { command -v clang-tidy && command -v clang++; } >/dev/null; then
      echo "analyse.sh: no clang-tidy here" >&2
      exit 77
    fi
    # Debian's ITK headers know no compiler but GCC. Several sources at a time, as headers are most of the work.
    cmake -S . -B "$build" -G Ninja -DBUILD_TESTING=OFF -DVOXELCORE_UNITY=ON -DVOXELCORE_ITK=OFF \
      -DCMAKE_BUILD_TYPE=Debug -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DCMAKE_C_COMPILER=clang \
      -DCMAKE_CXX_COMPILER=clang++ >/dev/null
    # A header that the build makes: without it a source is read in part, and what is found is wrong.
    cmake "-DMODULES=$source/Modules" "-DOUT=$build/Modules/Program/Report/SourceDigest.h" \
      -P Modules/CMake/SourceDigest.cmake
    # What is compiled, also by the build itself; sources of the parts that are left out have no command.
    python3 - "$source" "$build" "${folders[@]}" >"$build/sources" <<'PYTHON'
import json, os, sys
source, build, *folders = sys.argv[1:]
for path in sorted({entry["file"] for entry in json.load(open(f"{build}/compile_commands.json"))}):
    within = os.path.relpath(path, build if path.startswith(build + "/") else source)
    if any(within.startswith(folder + "/") for folder in folders):
        print(path)
PYTHON
    nice xargs -P "$jobs" -n 1 clang-tidy -p "$build" --config-file=.clang-tidy \
      --checks=-bugprone-suspicious-include --quiet <"$build/sources"
    ;;
  *)
    echo "analyse.sh: unknown kind '$kind'; there are cppcheck and clang-tidy" >&2
    exit 2
    ;;
esac
echo "Nothing found that is not known."
