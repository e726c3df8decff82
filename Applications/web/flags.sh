# How everything is compiled to WebAssembly, libraries and program alike: exceptions cross from one to the other.
# shellcheck shell=bash disable=SC2034
web_flags=(-O3 -msimd128 -fwasm-exceptions -sSUPPORT_LONGJMP=wasm)
export NODE_PATH=/usr/share/nodejs # where Debian has what emcc needs of Node's packages
command -v ccache >/dev/null && export EM_COMPILER_WRAPPER=ccache
