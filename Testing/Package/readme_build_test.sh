#!/usr/bin/env bash
# Does what README.md and the guide say from a fresh clone on: the quickstart, twice; the build by hand, with Python
# module and packages; installing; the pictures. In a copy of the sources.
# usage: readme_build_test.sh BUILD_DIR      exit 77: something needed is missing
set -euo pipefail

source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
scratch=$(realpath "$1")/package-test/readme
fail() {
  echo "readme_build_test.sh: $1" >&2
  exit 1
}
[ -r /usr/share/mricron/templates/aal.nii.gz ] ||
  { echo "readme_build_test.sh: mricron-data is not installed" >&2; exit 77; }
command -v Xvfb >/dev/null || { echo "readme_build_test.sh: Xvfb is not installed" >&2; exit 77; }

rm -rf "$scratch"
mkdir -p "$scratch/clone"
cp -r "$source"/{Applications,Data,Modules,Testing,CMakeLists.txt,LICENSE,README.md} "$scratch/clone"
cd "$scratch/clone"

grep -qx '    bash Applications/quickstart.sh .*' README.md || fail "README.md has no quickstart"
bash Applications/quickstart.sh >"$scratch/first.log" </dev/null ||
  { cat "$scratch/first.log" >&2; fail "the quickstart failed"; }
[ -s build/quickstart/aal_medial.vtp ] && [ -s build/quickstart/aal_medial.json ] ||
  fail "the quickstart left no result"
# The first line of the guide's page on C++, with what the quickstart built.
cmake --install build/release --prefix "$scratch/at-once" >"$scratch/install.log" 2>&1 ||
  { tail -n 5 "$scratch/install.log" >&2; fail "after the quickstart VoxelCore cannot be installed"; }
"$scratch/at-once/bin/voxelcore" --version >/dev/null || fail "after the quickstart another program was installed"
rows=$(grep -c 'Hippocampus_[LR]' "$scratch/first.log") || true
[ "$rows" = 2 ] || fail "the quickstart printed $rows rows of the hippocampi"
bash Applications/quickstart.sh >"$scratch/second.log" </dev/null
grep -q 'its result is shown again' "$scratch/second.log" || fail "the second quickstart did everything again"

for file in aal.html aal.png; do
  [ -s "build/quickstart/$file" ] || fail "the quickstart left no $file"
done

# Indented lines, then what stands in backquotes.
guide=(Applications/manual/guide/{building,python,cpp}.md)
{
  sed -nE 's/^    ((bash Applications\/install|cmake (-S|build)|ninja |export PYTHONPATH).*)$/\1/p' "${guide[@]}"
  grep -ohE '`(cpack|cmake --install|bash Data)[^`]* [^`]+`' "${guide[@]}" README.md | tr -d '`'
} | grep -v 'install-packages.sh cluster' | sed "s|PREFIX|'$scratch/prefix'|" >"$scratch/lines.sh"
[ "$(wc -l <"$scratch/lines.sh")" -ge 9 ] || { cat "$scratch/lines.sh" >&2; fail "the guide lacks lines to build by"; }
echo 'cd /; /usr/bin/python3 -c "import voxelcore; print(voxelcore.__version__)"' >>"$scratch/lines.sh"
bash -eux "$scratch/lines.sh" >"$scratch/lines.log" 2>&1 </dev/null ||
  { tail -n 30 "$scratch/lines.log" >&2; fail "the lines of the guide failed"; }
for file in "$scratch"/prefix/{bin/voxelcore,share/man/man1/voxelcore.1} \
  "$scratch/prefix/lib/VoxelCore/qt-scripted-modules/VoxelCore.py" \
  {voxelcore,libvoxelcore-dev,python3-voxelcore}*.deb; do
  [ -s "$file" ] || fail "there is no $file"
done
[ -s "$scratch/prefix/lib/python3/dist-packages/voxelcore/__init__.py" ] || fail "the Python module was not installed"
for picture in Data/pictures/*.png; do
  cmp -s "$picture" "$source/$picture" || echo "$picture is not the one that was there"
  [ "$(stat -c %s "$picture")" -gt 10000 ] || fail "$picture is empty"
done
echo "readme: works"
