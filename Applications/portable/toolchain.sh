# How everything is compiled for a system, libraries and program alike.
# usage: system=linux-x86_64|linux-arm64|windows-x86_64|wasm; source toolchain.sh
# Sets compiler (of C), archiver, configure (cmake and what it must be told), flags, link_flags, module_path (where
# cmake looks for what finds libraries), runtimes (the packages with the licences of what the compiler links in), and
# foreign_math=yes where the C library's mathematics has other last bits than on Debian's x86-64.
# shellcheck shell=bash disable=SC2034
foreign_math=
runtimes=(libc6 libgomp1)
flags=(-O3)
link_flags=(-static -s)
module_path=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/cmake
cmake_cross() { # NAME-OF-SYSTEM PROCESSOR PREFIX-OF-COMPILERS SUFFIX
  compiler=$3gcc$4
  archiver=$3ar
  module_path+=";$module_path/threads"
  # Whole paths: by another name cmake takes it for another compiler, and begins anew.
  configure=(cmake -DCMAKE_SYSTEM_NAME="$1" -DCMAKE_SYSTEM_PROCESSOR="$2"
    -DCMAKE_C_COMPILER="$(command -v "$3gcc$4")" -DCMAKE_CXX_COMPILER="$(command -v "$3g++$4")"
    -DCMAKE_FIND_ROOT_PATH_MODE_PROGRAM=NEVER -DCMAKE_FIND_ROOT_PATH_MODE_LIBRARY=ONLY
    -DCMAKE_FIND_ROOT_PATH_MODE_INCLUDE=ONLY -DCMAKE_FIND_ROOT_PATH_MODE_PACKAGE=ONLY)
  if command -v ccache >/dev/null; then
    compiler="ccache $compiler"
    configure+=(-DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  fi
}
case "$system" in
  linux-x86_64) cmake_cross Linux x86_64 x86_64-linux-gnu- "" ;;
  linux-arm64)
    cmake_cross Linux aarch64 aarch64-linux-gnu- ""
    foreign_math=yes
    ;;
  windows-x86_64)
    cmake_cross Windows AMD64 x86_64-w64-mingw32- -posix # threads as C++ has them
    configure+=(-DCMAKE_RC_COMPILER="$(command -v x86_64-w64-mingw32-windres)")
    runtimes=(mingw-w64-common libgomp1)
    flags+=(-D_WIN32_WINNT=0x0A00 -D_FILE_OFFSET_BITS=64)
    foreign_math=yes
    ;;
  wasm)
    compiler=emcc
    archiver=emar
    # Sizes that cmake cannot find out of WebAssembly.
    configure=(emcmake cmake -DHAVE_SIZE_T=TRUE -DSIZE_T=4 -DHAVE_UNSIGNED_LONG=TRUE -DUNSIGNED_LONG=4
      -DHAVE_SIZEOF_SIZE_T=TRUE -DSIZEOF_SIZE_T=4 -DVOXELCORE_CCACHE=OFF)
    # Exceptions cross from libraries to the program.
    flags+=(-msimd128 -fwasm-exceptions -sSUPPORT_LONGJMP=wasm)
    foreign_math=yes
    link_flags=()
    module_path+=";$(dirname "$module_path")/../web/cmake"
    export NODE_PATH=/usr/share/nodejs # where Debian has what emcc needs of Node's packages
    command -v ccache >/dev/null && export EM_COMPILER_WRAPPER=ccache
    ;;
  *)
    echo "there are the systems linux-x86_64, linux-arm64, windows-x86_64 and wasm" >&2
    exit 2
    ;;
esac
