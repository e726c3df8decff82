#!/usr/bin/env bash
# Builds the libraries that VoxelCore needs for a system, from Debian's sources, into a folder with include/ and lib/.
# usage: libraries.sh SYSTEM FOLDER      SYSTEM: as in toolchain.sh. Does nothing where all are there
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
system=$1
mkdir -p "$2"
folder=$(cd "$2" && pwd)
# shellcheck source=toolchain.sh
source "$here/toolchain.sh"

packages="zlib bzip2 libpng1.6 libzstd lz4 c-blosc expat libjpeg-turbo tiff libmd"
# What is built: by these scripts, of these sources.
made_by=$(cat "$here/libraries.sh" "$here/toolchain.sh" | sha256sum)
if [ "$(cat "$folder/made-by" 2>/dev/null || true)" = "$made_by" ]; then
  exit 0
fi
rm -rf "$folder"
mkdir -p "$folder"/{include,lib,licences,source/lists/partial,build}

# A list of its own: where the system takes packages from stays as it is. apt checks what it gets.
cd "$folder/source"
mirror=$(cat /etc/apt/sources.list /etc/apt/sources.list.d/*.list /etc/apt/sources.list.d/*.sources 2>/dev/null |
  grep -oE 'https?://[^ ]+/debian/?( |$)' | head -n 1 | tr -d ' ' || true)
echo "deb-src ${mirror:-http://deb.debian.org/debian} bookworm main" >sources.list
apt_options=(-q -o "Dir::Etc::SourceList=$PWD/sources.list" -o Dir::Etc::SourceParts=/dev/null
  -o "Dir::State::lists=$PWD/lists" -o APT::Sandbox::User=root)
apt-get "${apt_options[@]}" update
# shellcheck disable=SC2086 # names of packages
apt-get "${apt_options[@]}" source --download-only $packages
for package in $packages; do
  dpkg-source --no-check -x "$package"_*.dsc "$package" >/dev/null
  cp "$package/debian/copyright" "$folder/licences/$package.txt"
  echo "$package $(sed -n 's/^Version: //p' "$package"_*.dsc | head -n 1)" >>"$folder/sources"
done
# Of the C library that Debian's programs have, its cube root: another's is another in the last bit, and so is that of
# Debian's own for ARM, which is compiled with products and sums in one step.
if [ -n "$foreign_math" ]; then
  apt-get "${apt_options[@]}" source --download-only glibc
  tar -xf glibc_*.orig.tar.xz --strip-components=4 --one-top-level=glibc --wildcards '*/sysdeps/ieee754/dbl-64/s_cbrt.c'
  cp /usr/share/doc/libc6/copyright "$folder/licences/glibc.txt"
fi

# library NAME FOLDER "FLAGS" FILE...
library() {
  local name=$1 from="$folder/source/$2" more=$3 file
  shift 3
  mkdir -p "$folder/build/$name"
  for file in "$@"; do
    # shellcheck disable=SC2086 # flags
    echo "cd '$from' && $compiler ${flags[*]} -w $more -c $file -o '$folder/build/$name/$(basename "$file" .c).o'"
  done | xargs -P "$(nproc)" -d '\n' -n 1 bash -c
  "$archiver" rcs "$folder/lib/lib$name.a" "$folder/build/$name"/*.o
}
headers() { cp "$@" "$folder/include/"; }
include="-I'$folder/include'"

cd "$folder/source"
headers zlib/zlib.h zlib/zconf.h bzip2/bzlib.h libpng1.6/png.h libpng1.6/pngconf.h libzstd/lib/zstd.h \
  libzstd/lib/zstd_errors.h c-blosc/blosc/blosc.h c-blosc/blosc/blosc-export.h expat/expat/lib/expat.h \
  expat/expat/lib/expat_external.h libmd/include/sha2.h
cp libpng1.6/scripts/pnglibconf.h.prebuilt "$folder/include/pnglibconf.h"
library z zlib "-DHAVE_UNISTD_H" adler32.c compress.c crc32.c deflate.c inffast.c inflate.c inftrees.c trees.c \
  uncompr.c zutil.c
library bz2 bzip2 "" blocksort.c bzlib.c compress.c crctable.c decompress.c huffman.c randtable.c
library png libpng1.6 "$include -DPNG_ARM_NEON_OPT=0" png.c pngerror.c pngget.c pngmem.c pngpread.c pngread.c \
  pngrio.c pngrtran.c pngrutil.c pngset.c pngtrans.c pngwio.c pngwrite.c pngwtran.c pngwutil.c
# shellcheck disable=SC2046 # names of files
library zstd libzstd "-DZSTD_DISABLE_ASM" $(cd libzstd && ls lib/common/*.c lib/compress/*.c lib/decompress/*.c)
library lz4 lz4 "" lib/lz4.c lib/lz4hc.c
cat >"$folder/source/c-blosc/blosc/config.h" <<'CONFIG'
#define HAVE_LZ4 1
#define HAVE_ZLIB 1
#define HAVE_ZSTD 1
CONFIG
blosc_names=
if [ "$system" = windows-x86_64 ]; then # it brings threads along, by names that the compiler's own have
  blosc_names=$(printf ' -Dpthread_%s=blosc_pthread_%s' create create join join cond_init cond_init \
    cond_destroy cond_destroy cond_signal cond_signal cond_broadcast cond_broadcast cond_wait cond_wait)
fi
library blosc c-blosc "$include -I../lz4/lib$blosc_names" blosc/blosc.c blosc/blosclz.c blosc/fastcopy.c \
  blosc/shuffle.c blosc/shuffle-generic.c blosc/bitshuffle-generic.c
printf '#define %s\n' XML_DEV_URANDOM "XML_DTD 1" "XML_NS 1" "XML_CONTEXT_BYTES 1024" "BYTEORDER 1234" \
  >expat/expat/lib/expat_config.h
library expat expat "-I expat/lib" expat/lib/xmlparse.c expat/lib/xmlrole.c expat/lib/xmltok.c
: >libmd/src/config.h
library md libmd "-I include -I src -DSHA2_UNROLL_TRANSFORM" src/sha2.c
if [ -n "$foreign_math" ]; then
  # What it asks goes by glibc's numbers for kinds of numbers.
  sed -i 's/fpclassify (x) <= FP_ZERO/(!isfinite (x) || x == 0)/' glibc/s_cbrt.c
  grep -q 'isfinite (x) || x == 0' glibc/s_cbrt.c || { echo "libraries.sh: another s_cbrt.c" >&2; exit 1; }
  touch glibc/math_private.h glibc/libm-alias-double.h
  library cbrt glibc "-I . -include math.h -ffp-contract=off -D__cbrt=cbrt -D__frexp=frexp -D__ldexp=ldexp \
    '-Dlibm_alias_double(a,b)='" s_cbrt.c
fi

library_by_cmake() { # SOURCE OPTION...
  "${configure[@]}" -S "$folder/source/$1" -B "$folder/build/$1" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_C_FLAGS="${flags[*]} -w" -DCMAKE_INSTALL_PREFIX="$folder" -DCMAKE_FIND_ROOT_PATH="$folder" \
    -DBUILD_SHARED_LIBS=OFF "${@:2}" >"$folder/build/$1.log" || { cat "$folder/build/$1.log" >&2; exit 1; }
}
library_by_cmake libjpeg-turbo -DENABLE_SHARED=OFF -DWITH_SIMD=OFF -DWITH_TURBOJPEG=OFF
ninja -C "$folder/build/libjpeg-turbo" jpeg-static
headers libjpeg-turbo/jpeglib.h libjpeg-turbo/jmorecfg.h libjpeg-turbo/jerror.h "$folder/build/libjpeg-turbo/jconfig.h"
cp "$folder/build/libjpeg-turbo/libjpeg.a" "$folder/lib/"
library_by_cmake tiff -DCMath_HAVE_LIBC_POW=TRUE \
  -Dtiff-tools=OFF -Dtiff-tests=OFF -Dtiff-contrib=OFF -Dtiff-docs=OFF -Dcxx=OFF -Djbig=OFF \
  -Dlerc=OFF -Dlzma=OFF -Dwebp=OFF -Dlibdeflate=OFF
ninja -C "$folder/build/tiff" tiff
headers tiff/libtiff/tiff.h tiff/libtiff/tiffio.h tiff/libtiff/tiffvers.h "$folder/build/tiff/libtiff/tiffconf.h"
cp "$folder/build/tiff/libtiff/libtiff.a" "$folder/lib/"

# Headers alone: Debian's own.
for name in boost CLI nlohmann; do
  ln -s "/usr/include/$name" "$folder/include/$name"
done
rm -rf "$folder/build" "$folder/source"
echo "$made_by" >"$folder/made-by"
