#!/usr/bin/env bash
# What Snakemake asks about a job of Slurm: running, success or failed. Works without accounting.
if told=$(scontrol --oneliner show job "$1" 2>&1); then
  case $(sed 's/.*JobState=\([A-Z_]*\).*/\1/' <<< "$told") in
    COMPLETED) echo success ;;
    PENDING | CONFIGURING | RUNNING | COMPLETING | SUSPENDED | STOPPED | RESIZING | REQUEUED | SIGNALING) echo running ;;
    *) echo failed ;;
  esac
elif [[ $told == *"Invalid job id"* ]]; then
  echo failed # forgotten: it is done again, and finds its results
else
  echo running # nobody can tell now
fi
