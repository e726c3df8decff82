#!/usr/bin/env bash
# Applications/debian, by which Debian builds its packages.
# usage: debian_test.sh names BUILD_DIR    what it says of version and of what a build needs is said elsewhere, too
#        debian_test.sh build BUILD_DIR    the commit that is checked out is built by dpkg-buildpackage in a folder of
#                                          its own; lintian finds nothing; debian/tests pass with what was built
# exit 77: it cannot be done here, with the reason
set -euo pipefail

how=$1
build=$(realpath "$2")
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
debian=$source/Applications/debian
fail() {
  echo "debian_test.sh: $1" >&2
  exit 1
}
skip() {
  echo "debian_test.sh: $1" >&2
  exit 77
}

if [ "$how" = names ]; then
  # What install-packages.sh installs for a build with the module, but for what Debian always has there or leaves out.
  eval "$(sed -n '/^packages_of/,/^}/p' "$source/Applications/install-packages.sh")"
  wanted=$({ packages_of build; packages_of python; } | tr ' ' '\n' |
    grep -vxE 'g\+\+|ccache|libtet1.5-dev|python3-vtk9' | sort)
  given=$(sed -n '/^Build-Depends:/,/^[^ ]/s/^ \([^ ,]*\).*/\1/p' "$debian/control" |
    grep -vxE 'debhelper-compat|dh-sequence-python3' | sort)
  [ "$(wc -w <<<"$given")" -gt 15 ] || fail "these are too few: $given"
  diff <(echo "$wanted") <(echo "$given") || fail "debian/control and install-packages.sh differ in what a build needs"
  exit 0
fi

for tool in dpkg-buildpackage dh dh_python3 lintian; do
  command -v "$tool" >/dev/null || skip "$tool is not installed: install-packages.sh debian"
done
git -C "$source" rev-parse HEAD >/dev/null 2>&1 || skip "the sources are in no git repository"
scratch=$build/package-test/debian-source
version=$(bash "$source/Applications/release/version.sh")
tree=$scratch/voxelcore-$version
rm -rf "$scratch"
mkdir -p "$scratch"
git -C "$source" archive --prefix="voxelcore-$version/" HEAD | gzip -n >"$scratch/voxelcore_$version.orig.tar.gz"
tar -xzf "$scratch/voxelcore_$version.orig.tar.gz" -C "$scratch"
cp -r "$tree/Applications/debian" "$tree/debian"
cd "$tree"
dpkg-checkbuilddeps >"$scratch/needs.log" 2>&1 || skip "$(tail -n 1 "$scratch/needs.log")"

dpkg-buildpackage -us -uc -S -d >"$scratch/source.log" 2>&1 ||
  { tail -n 30 "$scratch/source.log" >&2; fail "no source package can be made"; }
# A variable of the builder's own, such as DEB_BUILD_OPTIONS=noautodbgsym, is kept.
CCACHE_BASEDIR=$tree CCACHE_NOHASHDIR=1 PATH=/usr/sbin:/usr/bin:/sbin:/bin \
  dpkg-buildpackage -us -uc -b >"$scratch/build.log" 2>&1 ||
  { tail -n 40 "$scratch/build.log" >&2; fail "the packages cannot be built"; }
cd "$scratch"
lintian --fail-on error,warning --allow-root *_source.changes *_"$(dpkg --print-architecture)".changes \
  >"$scratch/lintian.log" 2>&1 || { cat "$scratch/lintian.log" >&2; fail "lintian finds faults"; }
cat "$scratch/lintian.log"

# As autopkgtest would run them where the packages are installed: here they lie in a folder.
mkdir "$scratch/root"
for package in *.deb; do
  dpkg -x "$package" "$scratch/root"
done
usr=$scratch/root/usr
export PATH=$usr/bin:/usr/bin:/bin PYTHONPATH=$usr/lib/python3/dist-packages CMAKE_PREFIX_PATH=$usr
[ "$(command -v voxelcore)" = "$usr/bin/voxelcore" ] || fail "another program is tested"
names=$(sed -n 's/^Tests: //p' "$tree/debian/tests/control")
[ "$(wc -w <<<"$names")" = "$(cd "$tree/debian/tests" && ls | grep -cvx control)" ] || fail "tests without a name"
for name in $names; do
  mkdir "$scratch/$name"
  (cd "$tree" && AUTOPKGTEST_TMP=$scratch/$name "debian/tests/$name" >"$scratch/$name.log" 2>&1) ||
    { tail -n 30 "$scratch/$name.log" >&2; fail "the test $name of debian/tests fails"; }
done
echo "Debian's packages: built, without a word of lintian, $(wc -w <<<"$names") tests pass"
