#!/usr/bin/env bash
# A dataset or a sweep as a task array of HyperQueue (docs/engines.md):
#   hyperqueue.sh PARTS wayside dataset RECIPE.toml --out DIR --threads 1
# Tasks whose worker dies begin again on another one, five times at most. Tasks that failed are submitted
# again, and all where none failed and runs lack (the next repeat of a study with [stop], which is known only
# then), as long as --conclude says something new: where it does not, failed tasks twice more and others no
# further. Run it in a folder that all workers see.
set -euo pipefail
parts=$1
shift
array=1-$parts
said=
in_vain=0
while true; do
  hq submit --array "$array" --crash-limit 5 --cpus 1 --env "PARTS=$parts" --wait \
    --stdout none --stderr 'hq-%{TASK_ID}.err' \
    -- bash -c '"$@" --quiet --shard "$HQ_TASK_ID/$PARTS"' part "$@" || true
  before=$said
  if said=$("$@" --quiet --conclude 2>&1); then
    printf '%s\n' "$said"
    exit 0
  fi
  printf '%s\n' "$said" >&2
  array=$(hq job task-ids last --filter=failed,canceled)
  if [ "$said" != "$before" ]; then
    in_vain=0
  elif [ -z "$array" ] || [ "$((++in_vain))" -ge 2 ]; then
    exit 1
  fi
  array=${array:-1-$parts}
done
