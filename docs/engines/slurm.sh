#!/usr/bin/env bash
# A sweep with [stop] as job arrays of Slurm, one after another (docs/engines.md):
#   slurm.sh PARTS wayside sweep STUDY.toml --out DIR
# Each array makes a repeat at least, waits for all of its parts, and the next is submitted as long as
# --conclude says something new. Run it in a folder that all nodes see.
set -euo pipefail
parts=$1
shift
here=$(dirname "$0")
said=
while true; do
  sbatch --wait --array="1-$parts" "$here/slurm.sbatch" "$parts" "$@" || true
  before=$said
  if said=$("$@" --quiet --conclude 2>&1); then
    printf '%s\n' "$said"
    exit 0
  fi
  printf '%s\n' "$said" >&2
  if [ "$said" = "$before" ]; then
    exit 1
  fi
done
