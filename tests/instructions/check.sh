#!/usr/bin/env bash
# What a scene does not name is not in its instructions (numerics A.13 ii): compiles small scenes and reads what came out.
set -euo pipefail
[[ $# == 4 ]] || {
    echo "usage: check.sh absent|watch|terms COMPILER FLAGS_FILE SCRATCH" >&2
    exit 2
}
what=$1 compiler=$2 flags=$3 out=$4/$1
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
skipped=77
if ! grep -qx -e '-O[23]' "$flags" || grep -q -e '-fsanitize' "$flags" || [[ $(uname -m) != x86_64 ]]; then
    echo "skipped: instructions are compared on x86-64, with -O2 or -O3 and no sanitizer"
    exit $skipped
fi
mkdir -p "$out"

build() # NAME SOURCE FLAGS...: an object and a program
{
    local name=$1 source=$2
    shift 2
    "$compiler" "@$flags" "$@" -c "$here/$source" -o "$out/$name.o"
    [[ $source == terms.cpp ]] || "$compiler" "@$flags" "$out/$name.o" -o "$out/$name"
}
# One line a function whose name matches: no addresses, no bytes; sorted by name.
functions() # OBJECT PATTERN
{
    objdump -dC --no-show-raw-insn --no-addresses "$1" | awk -v pattern="$2" '
        /^<.*>:$/ { if (keep) print text; text = $0; keep = $0 ~ pattern; next }
        /^\t/ { gsub(/[ \t]+/, " "); sub(/ #.*/, ""); text = text "; " $0 }
        END { if (keep) print text }' | sort
}
same() # A B PATTERN: equal functions and equal bits
{
    local a b
    functions "$out/$1.o" "$3" > "$out/$1.txt"
    functions "$out/$2.o" "$3" > "$out/$2.txt"
    grep -q 'v\?sqrtp[ds]' "$out/$1.txt" || {
        echo "no function of $1 that matches $3 holds a sweep: the comparison would be empty" >&2
        exit 1
    }
    if ! cmp -s "$out/$1.txt" "$out/$2.txt"; then
        echo "instructions of $1 and $2 differ:" >&2
        diff <(cut -c1-150 "$out/$1.txt") <(cut -c1-150 "$out/$2.txt") | head -20 >&2 || true
        exit 1
    fi
    a=$("$out/$1") b=$("$out/$2")
    [[ $a == "$b" ]] || {
        echo "state hashes of $1 and $2 differ: $a, $b" >&2
        exit 1
    }
    echo "$1 and $2: $(wc -l < "$out/$1.txt") equal functions with $(tr ';' '\n' < "$out/$1.txt" | wc -l) instructions; state $a"
}
loops() { objdump -dC --no-show-raw-insn "$out/terms.o" | awk -f "$here/loops.awk" | sort -u; }
number() { awk -v terms="$1" '$1 == terms { print $2; exit }' "$out/loops.txt"; }

case $what in
    absent)
        build alone alone.cpp
        build whole alone.cpp -include spate/spate.hpp
        same alone whole 'spate::'
        ;;
    watch)
        build watch watched.cpp -DWATCH=Watch
        build no_watch watched.cpp -DWATCH=NoWatch
        same watch no_watch 'spate::sweep_cell'
        ;;
    terms)
        build terms terms.cpp
        loops > "$out/loops.txt"
        echo "inner loop of continuity and pressure force (P) with laminar viscosity (L), artificial viscosity (A), diffusion (D), central viscosity (M), tensile correction (T), XSPH (X):"
        echo "terms instructions stack-stores stack-loads divisions"
        cat "$out/loops.txt"
        for pair in 'P PL' 'P PA' 'P PD' 'PA PAD' 'PD PAD' 'P PM' 'P PT' 'P PX'; do
            read -r less more <<< "$pair"
            a=$(number "$less") b=$(number "$more")
            [[ -n $a && -n $b ]] || {
                echo "no inner loop found for $less or $more" >&2
                exit 1
            }
            ((a < b)) || {
                echo "a term deleted, but no instruction: $more has $b, $less has $a" >&2
                exit 1
            }
        done
        [[ $(wc -l < "$out/loops.txt") -ge 5 ]]
        awk '$3 > 0 { bad = 1; print "the inner loop of " $1 " stores to the stack " $3 " times" } END { exit bad }' "$out/loops.txt"
        ;;
    *)
        echo "check.sh: choose absent, watch or terms" >&2
        exit 2
        ;;
esac
