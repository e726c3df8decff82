#!/usr/bin/python3
"""Has the machine hold memory at hand for what is timed next.

usage: memory_at_hand.py MEGABYTES

A virtual machine may give freed memory back to its host. Its next first touch then costs a second or two a gigabyte.
So each timed program runs after a process that takes memory, touches it and ends.
"""
import mmap
import subprocess
import sys

MEGABYTES = 3000


def have_memory_at_hand(megabytes=MEGABYTES):
    subprocess.run([sys.executable, __file__, str(megabytes)], check=True)


if __name__ == "__main__":
    size = int(sys.argv[1]) << 20
    with mmap.mmap(-1, size, flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS) as memory:
        memory.madvise(mmap.MADV_HUGEPAGE)
        for place in range(0, size, 4096):
            memory[place] = 1
