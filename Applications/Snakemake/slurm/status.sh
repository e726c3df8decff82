#!/usr/bin/env bash
# Says of a SLURM job, in Snakemake's words, how it stands. Works without an accounting database.
state=$(scontrol show job "$1" --oneliner 2>/dev/null | grep -o 'JobState=[A-Z_]*' | cut -d= -f2)
[ -n "$state" ] || state=$(sacct -j "$1" --format=State --noheader --parsable2 2>/dev/null | head -n 1 | cut -d' ' -f1)
case "$state" in
  COMPLETED) echo success ;;
  PENDING | CONFIGURING | RUNNING | SUSPENDED | PREEMPTED | COMPLETING) echo running ;;
  *) echo failed ;;
esac
