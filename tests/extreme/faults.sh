#!/usr/bin/env bash
# What a user sees, and what is left on disk, when a run is interrupted or killed, the disk is full, or the folder of its
# outputs is taken away. EXECUTABLE is the dam break in two dimensions.
set -euo pipefail
[[ $# == 2 ]] || {
    echo "usage: faults.sh EXECUTABLE SCRATCH" >&2
    exit 2
}
executable=$1 scratch=$2
export OMP_WAIT_POLICY=passive
mkdir -p "$scratch"
steps=3000
scene=(--spacing 0.05 --until 1000 --threads 1 --quiet)
whole=("${scene[@]}" --steps "$steps" --every 1)
failed=0
fail()
{
    echo "faults: $*" >&2
    failed=1
}
expect_code() { [[ $1 == "$2" ]] || fail "$3: ended with $1 instead of $2, saying: $(head -c 500 "$scratch/stderr")"; }
expect_says() { grep -qF -- "$1" "$scratch/stderr" || fail "$2: does not say '$1' but: $(head -c 500 "$scratch/stderr")"; }
value() { sed -n "s/^ *\"$2\": \"\\{0,1\\}\\([^\",]*\\)\"\\{0,1\\},\\{0,1\\}\$/\\1/p" "$1/summary.json" | head -n 1; }
# No file is half written: each row of the history has all cells, and nothing temporary is left but what is named.
expect_whole()
{
    local dir=$1 allowed=${2-none} file
    for file in "$dir"/*.tmp; do
        [[ ! -e $file || $(basename "$file") == "$allowed" ]] || fail "$3: $(basename "$file") is left"
    done
    for file in "$dir"/history.csv*; do
        [[ -e $file ]] || continue
        awk -F, 'NR == 1 { n = NF } NF != n { bad = 1 } END { exit bad || NR < 1 }' "$file" || fail "$3: a row of $file is cut"
    done
}
last_checkpoint() { find "$1" -name 'checkpoint_*.h5' | sort -t_ -k2 -V | tail -n 1; }
# The run goes on from a checkpoint to the bits of one that nothing broke.
expect_goes_on()
{
    local code=0
    [[ -n $1 && -s $1 ]] || return "$(fail "$2: there is no checkpoint to go on from")0"
    "$executable" "${whole[@]}" --output "$scratch/again" --restart "$1" > "$scratch/stdout" 2> "$scratch/stderr" || code=$?
    expect_code "$code" 0 "$2, going on"
    [[ $(value "$scratch/again" state_hash) == "$whole_hash" ]] || fail "$2: other bits after the restart"
    expect_whole "$scratch/again" none "$2, going on"
    rm -rf "$scratch/again"
}
# Starts a run in the background; returns once it has written a checkpoint and some rows.
begin()
{
    rm -rf "$scratch/run"
    "$executable" "${whole[@]}" --checkpoint-every 200 --output "$scratch/run" > "$scratch/stdout" 2> "$scratch/stderr" &
    pid=$!
    for ((k = 0; k < 6000; ++k)); do
        [[ -z $(last_checkpoint "$scratch/run" 2> /dev/null) ]] || return 0
        kill -0 "$pid" 2> /dev/null || break
        sleep 0.01
    done
    fail "the run wrote no checkpoint"
}
end() # code of the run
{
    code=0
    wait "$pid" || code=$?
}

"$executable" "${whole[@]}" --output "$scratch/whole"
whole_hash=$(value "$scratch/whole" state_hash)
[[ -n $whole_hash ]] || fail "no state_hash in summary.json"

for signal in INT TERM USR1; do
    begin
    kill -s "$signal" "$pid"
    end
    expect_code "$code" $((128 + $(kill -l "$signal"))) "SIG$signal"
    expect_says "spate: interrupted by SIG$signal at step " "SIG$signal"
    last=$(last_checkpoint "$scratch/run")
    expect_says "--restart $last goes on from there" "SIG$signal"
    [[ $(value "$scratch/run" stop) == Interrupted ]] || fail "SIG$signal: summary.json does not say Interrupted"
    [[ $last == *"_$(value "$scratch/run" steps).h5" ]] || fail "SIG$signal: the checkpoint is not of the last step"
    expect_whole "$scratch/run" none "SIG$signal"
    expect_goes_on "$last" "SIG$signal"
done

# Killed: nothing can be said; the last checkpoint and the rows so far are there.
begin
kill -s KILL "$pid"
end 2> /dev/null
expect_code "$code" 137 SIGKILL
mv "$scratch/run" "$scratch/again" # goes on in its own folder, where a file that was being written may be left
: > "$scratch/again/checkpoint_9999.h5.tmp"
expect_goes_on "$(last_checkpoint "$scratch/again")" SIGKILL

# The folder of the outputs is taken away: the next file that is written says so.
begin
until rm -rf "$scratch/run" 2> /dev/null; do :; done
end
expect_code "$code" 4 "folder removed"
expect_says "spate: cannot write $scratch/run/" "folder removed"
expect_says "No such file or directory" "folder removed"
[[ ! -e $scratch/run ]] || fail "folder removed: it is there again"

# A full device under one file: /dev/full takes no byte.
for file in history.csv.tmp dam_break.png.tmp; do
    rm -rf "$scratch/run" && mkdir -p "$scratch/run"
    ln -s /dev/full "$scratch/run/$file"
    code=0
    "$executable" "${scene[@]}" --steps 30 --output "$scratch/run" > "$scratch/stdout" 2> "$scratch/stderr" || code=$?
    [[ $code == 4 ]] || fail "$file on a full device: ended with $code"
    expect_says "No space left on device" "$file on a full device"
done

# A full disk, of many sizes, so that another file is the first that does not fit.
on_small_disk()
{
    local size=$1 code=0
    mount -t tmpfs -o "size=$size" none "$scratch/disk" || exit 99
    "$executable" "${scene[@]}" --steps 3000 --every 0.01 --checkpoint-every 20 --output "$scratch/disk/run" \
        > "$scratch/stdout" 2> "$scratch/stderr" || code=$?
    rm -rf "$scratch/left" && cp -a "$scratch/disk/run" "$scratch/left" 2> /dev/null || :
    umount "$scratch/disk"
    exit "$code"
}
export -f on_small_disk
export executable scratch
mkdir -p "$scratch/disk"
run_on_small_disk() { unshare -Urm bash -c "scene=(${scene[*]}); on_small_disk $1"; }
if unshare -Urm mount -t tmpfs none "$scratch/disk" 2> /dev/null; then
    for size in 4k 60k 100k 140k 180k 220k 260k 300k; do
        code=0
        run_on_small_disk "$size" || code=$?
        [[ $code == 4 || ($code == 2 && $size == 4k) ]] ||
            fail "a disk of $size: ended with $code, saying: $(head -c 500 "$scratch/stderr")"
        expect_says "No space left on device" "a disk of $size"
        [[ $code == 4 ]] || continue
        expect_whole "$scratch/left" history.csv.tmp "a disk of $size"
        last=$(last_checkpoint "$scratch/left")
        echo "a disk of $size: $(head -n 1 "$scratch/stderr" | sed "s|$scratch/||g"); left: $(cd "$scratch/left" && echo *)"
        [[ -z $last ]] || expect_goes_on "$last" "a disk of $size"
    done
else
    echo "faults: no small disk can be mounted here; only /dev/full was tried"
fi

rm -rf "$scratch/run" "$scratch/whole" "$scratch/left" "$scratch/disk"
[[ $failed == 0 ]] && echo "faults: all as they should be"
exit "$failed"
