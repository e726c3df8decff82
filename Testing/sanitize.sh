#!/usr/bin/env bash
# Builds the tests of some modules with a sanitizer, in a folder of their own, and runs those that are not heavy, and
# with `address` the hostile files in full. Non-zero when a test fails or the sanitizer finds anything.
# usage: sanitize.sh address|thread BUILD_DIR "CONFIGURED;MODULES" "TESTED;MODULES"    exit 77: a package is missing
#
# address: AddressSanitizer with its leak check, and UndefinedBehaviorSanitizer, with the compiler at hand (CXX).
# thread:  ThreadSanitizer with clang and LLVM's OpenMP. GCC's own OpenMP is not built for it and every barrier would
#          look like a race; LLVM's tells ThreadSanitizer of its barriers by the tool libarcher (package libomp-dev).
#          What it says goes to files, as the program under test keeps what libraries write to standard error.
set -euo pipefail

kind=$1
build=$2
configured=$3
tested=$4
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
options=()

case "$kind" in
  address)
    flags="-fsanitize=address,undefined -fno-sanitize-recover=all -D_GLIBCXX_ASSERTIONS"
    # The bounds on memory are tested too: freed memory is held back, but not all of it.
    export ASAN_OPTIONS=detect_leaks=1:strict_string_checks=1:detect_stack_use_after_return=1:quarantine_size_mb=32
    export UBSAN_OPTIONS=print_stacktrace=1
    ;;
  thread)
    if ! command -v clang++ >/dev/null; then
      echo "sanitize.sh: clang is not installed" >&2
      exit 77
    fi
    archer=$(realpath -m "$(clang++ -print-resource-dir)/../../libarcher.so")
    if [ ! -e "$archer" ]; then
      echo "sanitize.sh: $archer is not there (package libomp-dev)" >&2
      exit 77
    fi
    flags="-fsanitize=thread"
    # Debian's ITK headers know no compiler but GCC; only its filters and the comparison with its readers are left out.
    options+=(-DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DVOXELCORE_ITK=OFF)
    export OMP_TOOL_LIBRARIES=$archer
    # Debian's libraries are not built for ThreadSanitizer: what they do among themselves is not looked at.
    mkdir -p "$build"
    reports=$(realpath "$build")/race
    rm -f "$reports".*
    export TSAN_OPTIONS=ignore_noninstrumented_modules=1:halt_on_error=1:second_deadlock_stack=1:log_path=$reports
    # More threads than processors, so that they interleave also on a small machine; those that wait leave it to others.
    export OMP_NUM_THREADS=4 KMP_BLOCKTIME=0
    ;;
  *)
    echo "sanitize.sh: unknown kind '$kind'; there are address and thread" >&2
    exit 2
    ;;
esac

# -O1: quick enough to run, and stack traces still name every function.
cmake -S "$source" -B "$build" -G Ninja -DBUILD_TESTING=ON \
  -DCMAKE_BUILD_TYPE=Sanitizer \
  -DCMAKE_CXX_FLAGS="-O1 -g1 -fno-omit-frame-pointer $flags" -DVOXELCORE_MODULES="$configured" "${options[@]}"

targets=()
for module in ${tested//;/ }; do
  for folder in "$module" Core/"$module" Scans/"$module" Models/"$module" Program/"$module" Uses/"$module"; do
    [ ! -e "$source/Testing/$folder/CMakeLists.txt" ] || targets+=("Testing/$folder/all")
  done
done
left_out="AreRefusedByThePythonModule" # Python is not built so
if [[ ";$tested;" == *";Applications;"* ]]; then
  targets+=(voxelcore voxelcore_faulty VoxelCoreVtkWay_faulty VoxelCoreItkWay_faulty)
else
  left_out+="|AreRefusedBy(TheProgram|FiltersOf)"
fi
cmake --build "$build" --target "${targets[@]}"

# Tests carry the name of their module as label.
run() {
  ctest --test-dir "$build" -L "^(${tested//;/|})\$" -LE heavy --output-on-failure --no-tests=error "$@" </dev/null
}
# The driver of OpenGL forgets 240 bytes and is gone when leaks are looked for: what draws is not asked for them.
draws='Render|AreDrawn|DrawnBy|Pictures|WritesAFileThatTheProgramTakes|AMissingVoxelSizeIsWarnedOf|NoOutputNamesA'
draws+='|TheExampleWritesTheLibrarysBytes|Guide.ItsCommandsRun|Guide.ItsTutorial|Help.ItsExamplesRun'
draws+='|FilesOfFormerVersionsAreRead'
run -E "$left_out|$draws"
if [ "$kind" = address ]; then
  ASAN_OPTIONS=$ASAN_OPTIONS:detect_leaks=0 run -R "$draws"
  ctest --test-dir "$build" -R '^HeavyHostile' --output-on-failure </dev/null
fi
