#!/usr/bin/env bash
# Command lines at random: whatever is asked of an example, it ends by itself with a code that it has, and says why.
set -euo pipefail
[[ $# == 4 ]] || {
    echo "usage: command_lines.sh EXECUTABLE COUNT SEED SCRATCH" >&2
    exit 2
}
executable=$1 count=$2 seed=$3 out=$4
RANDOM=$seed
mkdir -p "$out"

of() { # one of the arguments
    local k=$((RANDOM % $#))
    shift "$k"
    printf '%s' "$1"
}
number() { of 0 -0 1 2 -1 0.05 0.1 3.7 1e-9 1e300 -1e300 1e-320 nan inf -inf 99999999999999999999 0x10 1e 1,5 "" " " abc; }
mapfile -t options < <("$executable" --help | grep -oE -- '--[a-z]+(-[a-z]+)*' | sort -u | grep -vxE -- '--help|--output')
((${#options[@]} >= 5)) || {
    echo "$executable --help names ${#options[@]} options only" >&2
    exit 1
}
declare -A ends=()
bad=0
for ((k = 0; k < count; ++k)); do
    line=()
    for ((n = RANDOM % 5; n > 0; --n)); do
        line+=("$(of "${options[@]}" "${options[@]}" "${options[@]}" --nonsense --)")
        ((RANDOM % 5 == 0)) || line+=("$(number)")
    done
    # Last, so that a good line is short: coarse particles, few steps.
    ((RANDOM % 3 == 0)) || line+=(--spacing 0.1)
    line+=(--steps "$((RANDOM % 3))" --output "$out/run")
    code=0
    timeout 60 "$executable" "${line[@]}" > "$out/stdout" 2> "$out/stderr" < /dev/null || code=$?
    ends[$code]=$((${ends[$code]-0} + 1))
    case $code in
        0) continue ;;
        2 | 3 | 4) [[ ! -s $out/stderr ]] || continue ;;
    esac
    bad=$((bad + 1))
    echo "line $k of seed $seed ended with $code, saying \"$(head -c 300 "$out/stderr")\":" >&2
    printf ' %q' "$executable" "${line[@]}" >&2
    echo >&2
done
for code in "${!ends[@]}"; do echo "${ends[$code]} ended with $code"; done
rm -rf "$out/run"
[[ $bad == 0 ]]
