#!/usr/bin/python3
"""Has the machine hold memory at hand for what is timed next.

usage: memory_at_hand.py MEGABYTES

A virtual machine may give memory that is freed back to its host, and have to ask for it again: its first touch then
costs a second or two a gigabyte, now and not the next time. So programs that are to be compared each run after a
process that takes memory, touches it and ends.
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
