#!/usr/bin/env bash
# Makes a release of the commit that is checked out: runs every test, builds the source archive, the wheel, the Debian
# packages, the program for each system, the npm package and the page twice, each time in another folder, and compares
# the bits; writes checksums and what is in it (CycloneDX).
# usage: make-release.sh FOLDER [--without-tests] [--only PART,..]
# PART: source, wheel, packages, linux-x86_64, linux-arm64, windows-x86_64 or web; all of them where nothing is said.
# The second build does without the compiler's cache. Nothing is signed and nothing is uploaded.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source=$PWD
fail() {
  echo "make-release.sh: $1" >&2
  exit 1
}

[ $# -ge 1 ] || { sed -n 's/^# usage: /usage: /p' "${BASH_SOURCE[0]}" >&2; exit 2; }
mkdir -p "$1"
folder=$(cd "$1" && pwd)
shift
tests=yes
systems="linux-x86_64 linux-arm64 windows-x86_64"
parts=source,wheel,packages,${systems// /,},web
while [ $# -gt 0 ]; do
  case "$1" in
    --without-tests) tests=no ;;
    --only) parts=${2:?"--only: give parts, such as source,wheel"}; shift ;;
    *) echo "make-release.sh: unknown option '$1'" >&2; exit 2 ;;
  esac
  shift
done
for part in ${parts//,/ }; do
  [[ $part =~ ^(source|wheel|packages|${systems// /|}|web)$ ]] ||
    { echo "make-release.sh: unknown part '$part'" >&2; exit 2; }
done
has() { [[ ,$parts, == *,$1,* ]]; }

[ -z "$(ls -A "$folder")" ] || fail "$folder is not empty"
[ -z "$(git status --porcelain)" ] || fail "commit first: a release is made of a commit"
version=$(bash Applications/release/version.sh)
grep -qE "^## $version(\$| )" Applications/manual/CHANGELOG.md || fail "CHANGELOG.md has no section $version"
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH LC_ALL=C.UTF-8 TZ=UTC
umask 022

if [ "$tests" = yes ]; then
  bash Testing/run.sh --heavy
else
  echo "make-release.sh: tests were left out" >&2
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# A package whose files have the commit's time and belong to root, however it was made.
repack() {
  local root=$work/repacked
  rm -rf "$root"
  dpkg-deb -R "$1" "$root"
  find "$root" -exec touch -h -d "@$SOURCE_DATE_EPOCH" {} +
  dpkg-deb --root-owner-group -Zxz -b "$root" "$2/$(basename "$1")" >/dev/null
}

for round in 1 2; do
  out=$work/out-$round
  tree=$work/tree-$round-$RANDOM # another path each time
  mkdir -p "$out" "$tree"
  git archive HEAD | tar -x -C "$tree"
  cache=()
  [ "$round" = 1 ] || cache=(CCACHE_DISABLE=1)
  if has source; then
    git archive --prefix="voxelcore-$version/" HEAD | gzip -n -9 >"$out/voxelcore-$version.tar.gz"
  fi
  if has wheel; then
    env "${cache[@]}" bash "$tree/Applications/Python/wheel/make-wheel.sh" "$out"
  fi
  if has packages; then
    bash "$tree/Applications/install-packages.sh" build python package
    env "${cache[@]}" CCACHE_BASEDIR="$tree" CCACHE_NOHASHDIR=1 bash -euc '
      cmake -S "$1" -B "$1/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF -DVOXELCORE_TETGEN=OFF \
        -DVOXELCORE_PYTHON=ON -DCMAKE_C_FLAGS="-ffile-prefix-map=$1=." -DCMAKE_CXX_FLAGS="-ffile-prefix-map=$1=."
      cmake --build "$1/build"
      cd "$1/build" && cpack --config CPackConfig.cmake -B "$1/packed"' build "$tree" >"$out.log" 2>&1 ||
      { tail -n 30 "$out.log" >&2; fail "the packages cannot be built"; }
    for package in "$tree"/packed/*.deb; do
      repack "$package" "$out"
    done
  fi
  for system in $systems; do
    if has "$system"; then
      env "${cache[@]}" CCACHE_BASEDIR="$tree" CCACHE_NOHASHDIR=1 \
        bash "$tree/Applications/portable/build.sh" "$system" "$tree/build-$system" >"$out.log" 2>&1 ||
        { tail -n 30 "$out.log" >&2; fail "the program for $system cannot be built"; }
      cp "$tree/build-$system/voxelcore-$version-$system".* "$out/"
    fi
  done
  if has web; then
    env "${cache[@]}" bash "$tree/Applications/web/build.sh" "$tree/build-web" >"$out.log" 2>&1 ||
      { tail -n 30 "$out.log" >&2; fail "the web application cannot be built"; }
    cp "$tree/build-web/voxelcore-$version.tgz" "$out/"
    cp "$tree/build-web/voxelcore.html" "$out/voxelcore-$version.html"
    find "$tree/build-web/page" -exec touch -d "@$SOURCE_DATE_EPOCH" {} +
    tar --sort=name --owner=0 --group=0 --numeric-owner -C "$tree/build-web" \
      --transform "s,^page,voxelcore-$version-page," -c page | gzip -n -9 >"$out/voxelcore-$version-page.tar.gz"
  fi
  rm -rf "$tree"
done

[ "$(cd "$work/out-1" && ls)" = "$(cd "$work/out-2" && ls)" ] || fail "two builds gave other files"
differ=()
for file in "$work"/out-1/*; do
  cmp -s "$file" "$work/out-2/$(basename "$file")" || differ+=("$(basename "$file")")
done
if [ ${#differ[@]} -gt 0 ]; then
  mkdir -p "$folder/differ"
  for file in "${differ[@]}"; do
    cp "$work/out-1/$file" "$folder/differ/1-$file"
    cp "$work/out-2/$file" "$folder/differ/2-$file"
  done
  fail "two builds differ: ${differ[*]} (both are in $folder/differ)"
fi
cp "$work"/out-1/* "$folder/"
/usr/bin/python3 Applications/release/sbom.py "$version" "$folder" >"$folder/voxelcore-$version.cdx.json"
(cd "$folder" && sha256sum -- * >SHA256SUMS)
echo "voxelcore $version: two builds of $(ls "$work/out-1" | wc -l) files have the same bits"
