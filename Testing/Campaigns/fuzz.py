"""Files that libFuzzer makes up, led by which code they reach, through the readers under AddressSanitizer and
UndefinedBehaviorSanitizer: a format at a time.

usage: fuzz.py VOXELCORE BUILD_DIR --corpus DIR [--minutes M] [--formats a,b] [--totals FILE] [--jobs N]
       [--timeout S]

VOXELCORE, the program, writes the first files. Builds with clang in BUILD_DIR. --minutes: for each format (10).
--timeout: seconds a file may take (10); more where others use the machine. --corpus: a folder a format, of files that
reached something new; the next run goes on from them. A file that brings the readers down stays in DIR/found. Exit 1:
something was found."""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile

from campaign import Totals
from damaged_files import Seeds
from damaged_reads import FORMATS

SOURCE = os.path.realpath(f"{os.path.dirname(os.path.abspath(__file__))}/../..")
FLAGS = "-O1 -g1 -fno-omit-frame-pointer -D_GLIBCXX_ASSERTIONS -fsanitize=fuzzer-no-link,address,undefined " \
        "-fno-sanitize-recover=all"


def build(folder, jobs):
    # Debian's ITK headers know no compiler but GCC.
    subprocess.run(["cmake", "-S", SOURCE, "-B", folder, "-G", "Ninja", "-DBUILD_TESTING=ON", "-DVOXELCORE_ITK=OFF",
                    "-DCMAKE_C_COMPILER=clang", "-DCMAKE_CXX_COMPILER=clang++", "-DCMAKE_BUILD_TYPE=Sanitizer",
                    f"-DCMAKE_CXX_FLAGS={FLAGS}", "-DVOXELCORE_LIBFUZZER=ON"], check=True, stdout=subprocess.DEVNULL)
    subprocess.run(["ninja", "-C", folder, f"-j{jobs}", "VoxelCoreFuzzReads"], check=True, stdout=subprocess.DEVNULL)
    return os.path.join(folder, "bin", "VoxelCoreFuzzReads")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("build")
    parser.add_argument("--corpus", required=True)
    parser.add_argument("--minutes", type=float, default=10)
    parser.add_argument("--formats", default=",".join(FORMATS))
    parser.add_argument("--totals")
    parser.add_argument("--timeout", type=int, default=10)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    options = parser.parse_args()
    harness = build(os.path.realpath(options.build), options.jobs)
    totals = Totals(options.totals, "libFuzzer")
    before = len(totals.of["found"])
    bad = os.path.join(options.corpus, "found")
    os.makedirs(bad, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="voxelcore-fuzz-") as folder:
        seeds = Seeds(os.path.abspath(options.program), folder)
        for name in options.formats.split(","):
            kept = name.replace("/", "_")
            corpus = os.path.join(options.corpus, kept)
            os.makedirs(corpus, exist_ok=True)
            shutil.copy(seeds.path(name), os.path.join(corpus, "whole"))
            done = subprocess.run(
                [harness, corpus, f"-max_total_time={int(60 * options.minutes)}", f"-timeout={options.timeout}",
                 "-rss_limit_mb=2048", "-malloc_limit_mb=1024", "-max_len=65536", "-print_final_stats=1",
                 f"-artifact_prefix={bad}/{kept}-"],
                env={**os.environ, "VOXELCORE_FUZZ": f"{FORMATS[name]}:{folder}:{name}", "OMP_NUM_THREADS": "1",
                     "UBSAN_OPTIONS": "print_stacktrace=1"},
                stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                errors="replace", check=False)
            runs = int((re.findall(r"number_of_executed_units: (\d+)", done.stderr)
                        or re.findall(r"^#(\d+)", done.stderr, re.M) or [0])[-1])
            reached = (re.findall(r"\bcov: (\d+)", done.stderr) or [0])[-1]
            totals.ran(runs)
            totals.count(f"{name}, files", runs)
            totals.count(f"{name}, minutes", options.minutes)
            print(f"{name}: {runs} files, {reached} places reached, exit {done.returncode}", flush=True)
            if done.returncode:
                with open(f"{bad}/{kept}.log", "w", encoding="utf-8") as file:
                    file.write(done.stderr)
                said = re.findall(r"^(?:==\d+==\s*ERROR.*|SUMMARY.*|not one line.*|.*runtime error.*|.*terminate.*)$",
                                  done.stderr, re.M)
                totals.found(f"{name}: {' '.join(said)[:400]}; see {bad}/{kept}.log")
            totals.save()
    sys.exit(1 if len(totals.of["found"]) > before else 0)


if __name__ == "__main__":
    main()
