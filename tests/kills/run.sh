#!/usr/bin/env bash
# A run on ranks of which one, or all, are killed at random moments goes on from a whole file each time, on any number of ranks,
# and ends like one that was left alone.
set -euo pipefail
[[ $# == 4 ]] || {
    echo "usage: run.sh EXECUTABLE KILLS SEED SCRATCH" >&2
    exit 2
}
here=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
executable=$1 kills=$2 seed=$3 scratch=$4 steps=1000000 moved=0 before=-1
RANDOM=$seed
rm -rf "$scratch" && mkdir -p "$scratch/killed" "$scratch/whole"
export OMPI_MCA_odls_base_sigkill_timeout=1
newest()
{
    local file step newest=-1
    for file in "$scratch"/killed/checkpoint_*.h5; do
        step=${file##*_} step=${step%.h5}
        [[ ! $step =~ ^[0-9]+$ ]] || ((step <= newest)) || newest=$step
    done
    echo "$newest"
}
for ((k = 0; k < kills; ++k)); do
    ranks=$((RANDOM % 3 + 1))
    bash "$here/tools/mpirun.sh" "$ranks" "$executable" "$scratch/killed" "$steps" > "$scratch/log" 2>&1 &
    job=$!
    for ((waited = 0; k % 4 > 0 && waited < 600; ++waited)); do # else perhaps while it sets up
        ! grep -q begun "$scratch/log" || break
        sleep 0.1
    done
    sleep "$(awk -v r=$RANDOM 'BEGIN { print 1.2 * r / 32768 }')"
    mapfile -t processes < <(pgrep -P "$job" || true)
    victim=$job # mpirun itself, or one of its ranks
    if ((${#processes[@]} > 0 && RANDOM % 4 > 0)); then victim=${processes[RANDOM % ${#processes[@]}]}; fi
    kill -KILL "$victim" 2> /dev/null || true
    for ((waited = 0; waited < 600; ++waited)); do # without mpirun ranks end by themselves
        alive=$(kill -0 "$job" 2> /dev/null && echo yes || true)
        for process in "${processes[@]}"; do kill -0 "$process" 2> /dev/null && alive=yes; done
        [[ -n $alive ]] || break
        sleep 0.1
    done
    [[ -z $alive ]] || {
        echo "kill $k: ranks hang" >&2
        kill -KILL "$job" "${processes[@]}" 2> /dev/null || true
        exit 1
    }
    wait "$job" 2> /dev/null || true
    ! grep -i "checkpoint.* is " "$scratch/log" || exit 1 # refused: it was not whole
    now=$(newest)
    ((now >= before)) || { echo "kill $k: step $before was there, now $now" >&2; exit 1; }
    ((now == before)) || moved=$((moved + 1))
    before=$now
done
((moved * 5 >= kills)) || { echo "only $moved of $kills runs came to a checkpoint" >&2; exit 1; }
end=$((before + 20))
killed=$(bash "$here/tools/mpirun.sh" 2 "$executable" "$scratch/killed" "$end" | tail -n 1)
whole=$(bash "$here/tools/mpirun.sh" 1 "$executable" "$scratch/whole" "$end" | tail -n 1)
echo "$kills kills, $moved times nearer to the end; $killed; in one piece $whole"
[[ ${killed##* } == "${whole##* }" ]]
cmp "$scratch/killed/history.csv" "$scratch/whole/history.csv"
cmp "$scratch/killed/tank.hdf.series" "$scratch/whole/tank.hdf.series"
[[ -z $(find "$scratch/killed" -name '*.tmp') ]]
